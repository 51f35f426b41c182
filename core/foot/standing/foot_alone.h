#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/foot/standing/standing_plane.h"
#include "core/geometry/point_cloud.h"
#include "core/result.h"

namespace instep {

/// A foot without what came with it in the cloud.
struct FootAlone {
  PointCloud cloud;
  std::optional<StandingPlane> floor;          ///< that it was seen to stand on
  std::optional<Result<StandingPlane>> plane;  ///< under it, where looking for a floor told that
  double stray_share = 0.0;                    ///< of the points, left out
  std::vector<std::string> warnings;           ///< of what was left out

  /// Whether strays are more than a word is worth; some of them may have passed for skin.
  bool had_many_strays() const;
};

/// Leaves out repeated points, strays, most of a leg that stands upright on the foot (across one
/// that leans toes would go with it), a floor, and bodies apart from the foot or beside it. Refuses
/// fewer than 200 points, and a foot that something large touches.
///
/// `is_told`: how the foot stands is known; then neither a floor nor a leg is looked for, which do
/// no harm. `is_one_foot`: as standing_body() takes it. `cloud` has passed check_cloud(). O(n log
/// n).
Result<FootAlone> foot_alone(const PointCloud& cloud, bool is_told, bool is_one_foot);

}  // namespace instep
