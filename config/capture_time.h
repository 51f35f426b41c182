#pragma once

#include <string>

#include "config/settings.h"

namespace instep {

/// Says that no scan can be done by capture.deadline_ms where cameras bring 30 frames a second, as
/// nearly all do; empty if it can. Simulated cameras that lose no time are left out.
std::string warning_of_short_deadline(const Settings& settings);

}  // namespace instep
