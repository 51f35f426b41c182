#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace instep {

struct StandingHeelPoint {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  /// Where it lies instead, as seen from there, if the edge is one standard deviation higher: of
  /// what the points and what is usual leave open. About a millimetre up the wall where no point
  /// shows the edge.
  Eigen::Vector3d one_deviation_off_mm = Eigen::Vector3d::Zero();
};

/// Where the side view of a heel that stands on the floor is furthest from a place over and before
/// it, such as the instep point: there a tape comes round the heel.
///
/// That place lies about where the round edge of the sole begins. A patch round it tells it badly:
/// where it is hangs on how the skin bends to either side, and the noise of few points hides just
/// that. So the whole back of the heel is fitted at once, by the distances of the points to it: a
/// wall that bends evenly on the way up and across, and an edge by which it goes over into the
/// floor in an arc or nearly so. That the edge has to reach the floor, and that the wall above goes
/// on as evenly as it came down, says most of what the patch does not. What lies far off the skin
/// that most points show does not count. How high the edge begins is held near what is usual, which
/// decides only where no point tells, as under a sole that was not seen.
///
/// `points`: those seen, at full size (core/foot/full_size.h) but else in the foot frame
/// (core/foot/foot_scan.h: pternion over the origin, floor at z = 0), of the heel or of all the
/// foot. `foot_length_mm` > 0. Nothing where they show no such heel, or too little of it to tell
/// its wall and how sure the place is, or where the place would be at the floor or too high for the
/// wall to tell. O(n): some four milliseconds for each thousand points of the heel.
std::optional<StandingHeelPoint> furthest_of_standing_heel(
    const std::vector<Eigen::Vector3d>& points, double foot_length_mm,
    const Eigen::Vector3d& place);

}  // namespace instep
