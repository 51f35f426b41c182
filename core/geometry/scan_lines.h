#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// Lines of points that stand closer on each than from line to line, as a line scanner leaves them.
struct ScanLines {
  double step = 0.0;   ///< from point to point on a line
  double apart = 0.0;  ///< from line to line, on the mean: the area that a length of line has
};

/// Whether most points have their nearest ones on a line with them, as some 40 of them tell.
/// `points` in the order of their first coordinate; `reach` > 0: five of their spacings or more,
/// less than half of what a slab of them is wide. Looks through those that are within `reach` in
/// the first coordinate.
bool stand_in_lines(const std::vector<Eigen::Vector3d>& points, double reach);

/// As most points see them, within `widest` > 0, seen along the direction in which their lines
/// spread least: noise across the surface hides none. Nothing if most see no second line there. To
/// within a quarter or so. Looks up to a dozen times at all points that are within `widest` of some
/// 40.
std::optional<ScanLines> scan_lines(const PointIndex& index, double widest);

}  // namespace instep
