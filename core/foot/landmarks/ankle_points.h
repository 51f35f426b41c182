#pragma once

#include <optional>

#include "core/foot/foot_scan.h"
#include "core/foot/skin/foot_outline.h"

namespace instep {

/// The inner ankle: the most medial point of the skin at 0.22-0.38 of the foot's length over the
/// floor, weighed by nearness to 0.30. Right-foot form. Nothing where the leg is cut too low to
/// tell.
std::optional<Landmark> find_medial_malleolus(const FootOutline& outline);

}  // namespace instep
