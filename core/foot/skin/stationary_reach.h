#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace instep {

/// How much of the skin round a place is looked at, as half-widths > 0.
struct ReachPatch {
  double around_mm = 0.0;  ///< on the way round the axis
  double across_mm = 0.0;  ///< along the axis
};

/// The place of the skin, near `start`, where its distance from an axis across the foot is
/// stationary: largest or smallest on the way round, and level across. The axis runs along y
/// through `axis_place`.
///
/// Seen round the axis such skin hardly rises or falls, so that few terms follow it over a wide
/// patch, and the noise of many points averages out. The place is no further from `start` than the
/// patch reaches. Nothing where too few points are near, where a half-width is not > 0, or
/// where nothing in the patch is stationary in the way that is asked for.

/// Where smooth skin is nearest to the axis on the way round: a cubic over it, a parabola across.
std::optional<Eigen::Vector3d> nearest_reach(const std::vector<Eigen::Vector3d>& points,
                                             const Eigen::Vector3d& axis_place,
                                             const Eigen::Vector3d& start, const ReachPatch& patch);

/// Where the skin is furthest from the axis and may bend more on the one side than on the other, as
/// a heel does where the round edge of the sole begins: two parabolas over the way round that meet
/// level at the place, and fall off from it on both sides and across.
std::optional<Eigen::Vector3d> furthest_reach(const std::vector<Eigen::Vector3d>& points,
                                              const Eigen::Vector3d& axis_place,
                                              const Eigen::Vector3d& start,
                                              const ReachPatch& patch);

}  // namespace instep
