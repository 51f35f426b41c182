#pragma once

#include <string>

#include "config/settings.h"

namespace instep {

/// Says which of store, socket and simulated pedal are to be at one place, where only one of them
/// can be; empty if each has its own.
std::string warning_of_shared_paths(const Settings& settings);

}  // namespace instep
