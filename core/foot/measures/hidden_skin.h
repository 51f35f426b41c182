#pragma once

#include "core/foot/foot_scan.h"
#include "core/geometry/point_cloud.h"
#include "core/geometry/seen_skin.h"
#include "core/girth/girth.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// What a tape round a standing foot may be wrong by for running over skin that no camera saw, to
/// be added to the half of its 95 % interval, as squares; foot frame, with the floor at z = 0.

/// Below the wall the skin is taken to go on in its bend (close_sole()): by 0.5 mm for each 10 mm
/// of the tape there, independent of each other. O(points).
double doubt_of_guessed_skin(const PointCloud& cloud, const TapePlane& plane);

/// Where the wall was lost before it began to bend, as between two feet, nothing tells where it
/// does: it may as well go down straight and bend at the floor only, or turn in at once.
struct HiddenWall {
  double height_mm = 0.0;  ///< over the floor, of the highest that was lost so
  double share = 0.0;      ///< that, of the section's height over the floor
  double doubt_mm = 0.0;   ///< 0 where the bend of all walls was seen
};

/// `girth`: of a foot on a platform. O(corners of the section * log(points)).
HiddenWall hidden_wall(const SeenSkin& seen, const TapePlane& plane, const Girth& girth);

/// Where the sole may lie deeper, as one that was not seen (FootScan::floor_below) or that lies
/// between the level lines of a scanner (below_last_line_mm()), a tape that passes under it is
/// longer, by what its round edges have below. Zero of a tape that stays above. O(corners of the
/// section).
double doubt_of_deeper_sole(const FloorBelow& floor, const TapePlane& plane, const Girth& girth);

}  // namespace instep
