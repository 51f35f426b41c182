#pragma once

#include <optional>
#include <string>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"

namespace instep {

/// Why a measure is withheld whose interval holds so much that a foot which was not measured could
/// be told as well: wider, to either side, than an eighth of it and 5 mm, or than 10 degrees.
/// Nothing where it says more than that.
std::optional<std::string> why_useless(const Measure& measure, const FootScan& foot);

}  // namespace instep
