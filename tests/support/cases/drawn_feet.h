#pragma once

#include <cstdint>
#include <string>

#include "core/geometry/point_cloud.h"
#include "core/geometry/rigid_transform.h"
#include "sim/truth.h"

namespace instep::test {

/// A simulated foot as a scanner might hand it over, with what is true of it.
struct DrawnFoot {
  std::string making;  ///< in a few words
  FootTruth truth;
  PointCloud cloud;  ///< no normals, no sigma: as most files are
  RigidTransform input_from_solid = RigidTransform::Identity();
  double top_mm = 0.0;       ///< where the leg is cut
  bool sole_is_seen = true;  ///< otherwise it is open underneath, and upright
};

/// Of how many drawn feet the sole is seen: of seven in ten, or of none, as a station without a
/// camera under its platform has it.
enum class SolesSeen { kMostly, kNever };

/// One foot of the simulated station's population (sim/solids/foot_parameters.h), drawn by the
/// seed: left or right, 8 to 50 thousand points, noise of 0.05 to 0.5 mm along the normal, up to
/// three holes of up to 10 mm radius, at times strays round it, the leg cut 80 to 200 mm over the
/// floor. A foot with its sole lies in any pose at all; one whose sole was not seen stands upright
/// and looks anywhere. Cost: some seconds, most of them for the truth.
DrawnFoot draw_scanned_foot(std::uint64_t seed, SolesSeen soles = SolesSeen::kMostly);

/// The same foot's points alone, without its truth.
DrawnFoot draw_scanned_foot_without_truth(std::uint64_t seed, SolesSeen soles = SolesSeen::kMostly);

}  // namespace instep::test
