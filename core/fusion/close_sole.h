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
  double most_inset_mm = 45.0;
  double usual_radius_mm = 8.0;  ///< of the rounding, where the seen wall is upright to its end
  /// The contact is put where the lowest seen wall, continued as an arc, meets the platform; this
  /// factor on its distance makes up for the arc that a straight tape cuts off. Measured on upright
  /// walls with roundings of 4, 8 and 12 mm seen from 15, 30 and 45 degrees above: the stretched
  /// girth is off by -0.7 to 0.7 mm, but at 45 degrees, where the rounding is hardly seen, by -1.7
  /// (8 mm) to 1.0 mm (12 mm).
  double inset_factor = 0.7;
};

struct SoleClosure {
  std::size_t points_added = 0;
  double area_mm2 = 0.0;    ///< that was closed
  double seen_share = 0.0;  ///< of the footprint whose sole a camera saw
};

/// Puts points (PointOrigin::kPlatform, normal down) on the standing plane inside the footprint of
/// a foot, where no camera saw the sole, so that a tape finds something below.
///
/// How far inside: the bottom of a foot is round, and cameras above see the rounding down to some
/// height z, where its normal points an angle phi below the horizon. An arc through there that is
/// tangent to the platform touches it z cos(phi) / (1 - sin(phi)) further in. This follows the
/// radius of the rounding by itself, leaves the hollow under an arch free, and needs no outline
/// that is exact. The cloud is in the station frame and has normals.
SoleClosure close_sole(PointCloud& foot, double standing_height_mm,
                       const SoleSettings& settings = {});

}  // namespace instep
