#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// The point of a surface that lies furthest along `direction` (unit length), told from points on
/// it so that neither a stray point nor the noise of the points moves it.
///
/// The start is the median of the five furthest points, which ignores two strays. Where at least
/// twelve points lie within 6 mm of it and no deeper than 2 mm, a quadratic surface is fitted to
/// them and its summit is taken, but no further out than the second furthest of them: this removes
/// the outward pull of noise and the inward pull of wide spacing. `points` must not be empty. O(n).
Eigen::Vector3d robust_extreme(const std::vector<Eigen::Vector3d>& points,
                               const Eigen::Vector3d& direction);

}  // namespace instep
