#pragma once

#include <array>
#include <map>
#include <string>

#include "core/foot/side.h"
#include "core/geometry/rigid_transform.h"
#include "core/result.h"
#include "sim/solids/foot_solid.h"

namespace instep {

/// What is true of a simulated foot, from the solid itself: no cloud, no mesh, no camera.
///
/// Frame: that of core/foot/foot_scan.h, its x axis from the pternion to the second toe. FL is
/// foot_length; mm at full size are FL / 260 each (core/foot/full_size.h); the outline is the
/// shadow on the floor of the body up to z = 25 mm at full size.
///
/// Landmarks:
///   pternion         rearmost point of the outline
///   toe2             where the axis leaves the outline in front: the axis runs from the pternion
///                    over the middle of the second toe's tip, which the solid knows
///   acropodion       foremost point of the outline
///   mt               most medial point of the outline in 0.60-0.80 FL, less a handicap of 1 mm
///                    at full size for each (0.04 FL)^2 off 0.69 FL
///   mf               most lateral point of the outline in 0.50-0.75 FL, 15 mm at full size or more
///                    behind mt, with the same handicap off 0.63 FL
///   instep           highest point of the back of the foot at 0.50 FL
///   lateral_midfoot  P2, the lateral outline point in 0.25-0.45 FL nearest to `instep` seen from
///                    above
///   medial_arch      P3, the medial outline point in 0.35-0.60 FL that makes instep_girth least
/// An outline point has the height at which the body reaches furthest.
///
/// Measures (stretched girths, all of closed sections, the sole included):
///   foot_length              pternion to acropodion along x
///   foot_breadth             mt to mf, seen from above
///   foot_breadth_horizontal  extent of the outline along y in 0.50-0.85 FL
///   ball_girth               vertical plane through mt and mf
///   instep_girth             plane through `instep` and the floor below P2 and P3
///   waist_girth              midway: plane through the means of the two planes' medial points (the
///                            floor below mt and P3), lateral points (below mf and P2) and dorsal
///                            points (`instep`, and the same height above the middle of mt and mf)
struct FootTruth {
  Side side = Side::kRight;
  RigidTransform foot_from_solid = RigidTransform::Identity();
  std::map<std::string, Eigen::Vector3d> landmarks;              ///< foot frame
  std::map<std::string, std::array<Eigen::Vector3d, 3>> planes;  ///< girth id -> points, foot frame
  std::map<std::string, double> measures;                        ///< id -> mm
  std::map<std::string, double> contact_mm;  ///< girth id -> length along the skin
};

/// Good to about 1e-3 mm. Fails with kInternal if the foot has no such section, which no drawn foot
/// does. Cost: about a second.
Result<FootTruth> foot_truth(const FootSolid& foot);

}  // namespace instep
