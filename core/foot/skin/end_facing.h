#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace instep {

/// How squarely the skin faces along `direction` (unit length) at its furthest place `end`: the
/// median of |normal . direction| over the points up to 2.5 mm behind it and 15 mm beside it, each
/// normal by the points up to 5 mm round, all at full size (full_size.h); of a crowd the means over
/// a cell of a millimetre count. Near 1 where the skin closes, as on a heel or a toe; near 0 where
/// it runs on and only the points end. Nothing without points there. O(n log n) for the points near
/// the end, and some tens of milliseconds at most, where they fill all the space there.
std::optional<double> end_facing(const std::vector<Eigen::Vector3d>& points,
                                 const Eigen::Vector3d& end, const Eigen::Vector3d& direction);

/// Of a heel that was not seen to its end. Of 200 drawn feet and 32 scans of the simulated station
/// whole heels have 0.947 and more; of feet of 1,500 points 3 of 40 less than this. With 4 mm cut
/// off they have 0.95 or less, as a rule 0.88, with 8 mm 0.87 or less.
inline constexpr double kLeastFacingOfHeel = 0.92;

}  // namespace instep
