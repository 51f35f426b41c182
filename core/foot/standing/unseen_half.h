#pragma once

#include <optional>
#include <string>

#include "core/foot/foot_scan.h"

namespace instep {

/// The half of a foot's end of which nothing was seen though its other half was, in words, such as
/// "the left half of its heel"; nothing if there is none, or the cloud has no normals.
///
/// Cameras that all stand to one side of a foot do not see round its heel or its toes: the rearmost
/// or foremost place that was seen then lies at the edge of what was, up to 40 mm beside the true
/// one, and the axis is turned by some ten degrees. So no measure is any good.
///
/// `foot` is aligned; left is what a customer calls so. O(points).
std::optional<std::string> unseen_half(const FootScan& foot);

}  // namespace instep
