#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/girth/tape_plane.h"

namespace instep {

/// Whether a closed line on a tape plane, in its own coordinates, goes by all three control points:
/// within a fiftieth of its length, for they may be read off noisy points. Of two bodies that the
/// plane cuts it is then the one that was pointed at.
bool goes_by_control_points(const std::vector<Eigen::Vector2d>& contour, const TapePlane& plane);

}  // namespace instep
