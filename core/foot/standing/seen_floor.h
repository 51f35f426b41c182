#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/foot/standing/standing_plane.h"

namespace instep {

/// The floor on which a body stands, where the cloud holds points of it.
struct SeenFloor {
  StandingPlane plane;
  std::vector<std::size_t> above;  ///< indices of the points that stand above it, ascending
};

/// Looks for a level skin round the body, outside of what it covers as seen from above: a rim that
/// was cut out with it or a whole room's floor. `plane`: as find_standing_plane() has it for all
/// points, within some millimetres and degrees of the floor. Points up to 3 mm above the floor, or
/// four times its own scatter, are taken for it; so are those under the body. Nothing where too
/// little lies there, or on too few of its sides, and where it is not level or
/// climbs to the body, as skin does. O(n).
std::optional<SeenFloor> seen_floor(const std::vector<Eigen::Vector3d>& points,
                                    const StandingPlane& plane);

}  // namespace instep
