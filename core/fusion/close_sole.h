#pragma once

#include <cstddef>

#include "core/geometry/point_cloud.h"

namespace instep {

struct SoleSettings {
  double spacing_mm = 2.0;
  double sigma_mm = 0.5;           ///< how well the platform stands for the sole that rests on it
  double outline_below_mm = 35.0;  ///< points up to this height make the outline
  double bridge_mm = 8.0;          ///< gaps in the outline up to twice this are closed
  double least_inset_mm = 3.0;
  double most_inset_mm = 55.0;
  double usual_radius_mm = 8.0;  ///< of the rounding, where the seen wall is upright to its end
  /// The contact is put where the lowest seen wall, continued as an arc, meets the platform. Below
  /// a rounded edge, the nearer end of the range, this factor on the distance makes up for the arc
  /// that a straight tape cuts off.
  double inset_factor = 0.75;
  /// The same where the arc ends 24 mm in or further: an arch, whose roof flattens on its way in.
  double arch_factor = 1.0;
};

struct SoleClosure {
  std::size_t points_added = 0;
  double area_mm2 = 0.0;         ///< that was closed
  double seen_share = 0.0;       ///< of the footprint whose sole a camera saw
  double widest_inset_mm = 0.0;  ///< from the lowest seen skin to where contact is guessed
};

/// Puts points (PointOrigin::kPlatform, normal down) on the standing plane inside the footprint of
/// a foot, where no camera saw the sole, so that a tape finds something below.
///
/// How far inside: the bottom of a foot is round, and cameras above see the rounding down to some
/// height z, where its normal points an angle phi below the horizon. An arc through there that is
/// tangent to the platform touches it z cos(phi) / (1 - sin(phi)) further in. This follows the
/// radius of the rounding by itself, leaves the hollow under an arch free, and needs no outline
/// that is exact. It is a guess: the wider the inset, the more so. The cloud is in the station
/// frame and has normals.
SoleClosure close_sole(PointCloud& foot, double standing_height_mm,
                       const SoleSettings& settings = {});

}  // namespace instep
