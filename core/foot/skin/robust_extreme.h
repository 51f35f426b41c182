#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// The point of a surface that lies furthest along `direction` (unit length), told from points on
/// it so that neither a stray point nor the noise of the points moves it.
///
/// The start is the median of the five furthest points, which ignores two strays. A quadratic
/// surface is fitted to the points round it, 6 mm wide or less where the skin is bent tighter, and
/// moved to its own summit until it stands there; the summit is taken. This removes the outward
/// pull of noise and the inward pull of wide spacing. Of fewer than twelve points round it the
/// start is moved as far before the furthest as each of the furthest is before the next one on
/// average, strays apart, and of fewer than seven in all it stands. `points` must not be empty.
/// O(n).
Eigen::Vector3d robust_extreme(const std::vector<Eigen::Vector3d>& points,
                               const Eigen::Vector3d& direction);

}  // namespace instep
