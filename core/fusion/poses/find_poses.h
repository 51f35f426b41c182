#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fusion/views/view.h"
#include "core/geometry/rigid_transform.h"
#include "core/go_on.h"
#include "core/result.h"
#include "core/workers.h"

namespace instep {

struct PoseFinding {
  double platform_height_mm = 0.0;  ///< z that the platform is to have in the station frame
};

struct FoundPose {
  RigidTransform station_from_camera = RigidTransform::Identity();
  double moved_mm = 0.0;    ///< of the camera, from its given place
  double turned_deg = 0.0;  ///< from its given direction
  /// 95 %: where it puts the object, against where all of them put it. Nothing of a camera alone.
  std::optional<double> known_to_mm;
  double overlap = 0.0;   ///< share of what it shows that another camera shows too
  double apart_mm = 0.0;  ///< median distance of that to what the other shows
  double stretch = 0.0;   ///< share by which its lens or its depth seems to be off, the larger
  bool is_level = true;   ///< the platform was seen; else its tilt and height are by the others
};

struct FoundPoses {
  std::vector<FoundPose> cameras;  ///< as the views that were given
  double unexplained_mm = 0.0;     ///< Registration::unexplained_after_mm
  std::vector<std::string> warnings;
};

/// Finds where the cameras of a station stand, from poses that are known roughly (a camera 150 mm
/// and 25 degrees from where it is said to be is found) and what all of them see of one object that
/// stands still on the platform: as large as a foot and not round, such as a last or a shoe.
///
/// Each view is levelled by the platform that it sees; then placed by where it sees the object
/// (place_roughly()); then all are fitted to each other (register_views()), without regard to the
/// given poses. The station frame stays what it was as far as it can: its z is square to the
/// platform, which lies at `platform_height_mm`; turn about it and place along it are those that
/// leave the cameras, on the whole, where they were said to be. A single camera is levelled, no
/// more. Lenses and depths are left as they are; what seems wrong of them is in the interval.
///
/// Fails with kInsufficientData where no camera sees the platform or the object is round, and,
/// naming the camera, where one sees no object, shares too little of it with the others, or its
/// pose is contradicted or not known to 3 mm after all, as of a box, of which two cameras share
/// level faces alone; kInvalidInput without a view, or with what fuse_views() fails with for
/// unsound ones; with kCancelled. Deterministic. Two to five seconds for four cameras, ten for six.
Result<FoundPoses> find_poses(const std::vector<View>& views, const PoseFinding& settings = {},
                              const Workers& workers = one_after_the_other,
                              const GoOn& go_on = always);

}  // namespace instep
