#pragma once

#include <cstddef>

#include "core/geometry/point_cloud.h"

namespace instep {

struct SoleSettings {
  double spacing_mm = 2.0;
  double sigma_mm = 0.5;  ///< how well the platform stands for the sole that rests on it
};

struct SoleClosure {
  std::size_t points_added = 0;
  double widest_inset_mm = 0.0;  ///< from the lowest seen skin to where contact is guessed
};

/// Puts points (PointOrigin::kPlatform) below a foot where no camera saw it, so that a tape finds
/// something there: on the standing plane where the sole is taken to rest on it, and between that
/// contact and the lowest seen skin on the skin as WallFoot continues it, walls that were lost high
/// up, as between two feet, included. So no surface has to be made up across that gap; one that is
/// bulges, and makes a tape too long.
///
/// At each place the continuations of the walls it lies inward of are averaged, the straightest
/// ahead most. The cloud is in the station frame and has normals. About 8 ms a foot.
SoleClosure close_sole(PointCloud& foot, double standing_height_mm,
                       const SoleSettings& settings = {});

}  // namespace instep
