#pragma once

#include <string>

#include "config/settings.h"

namespace instep {

/// All that holds for the station, said or not, as the lines that `instepd --check` prints. What
/// plays no part is left out, such as the pedal's times where there is no pedal.
std::string describe(const Settings& settings);

}  // namespace instep
