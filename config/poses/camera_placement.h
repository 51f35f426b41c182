#pragma once

#include <optional>
#include <string>

#include "core/fusion/frames/depth_frame.h"
#include "core/geometry/rigid_transform.h"

namespace instep {

/// What the settings say of a real camera's place in the station and of its lens; the same for
/// every family of cameras.
struct CameraPlacement {
  std::string name;  ///< 1 to 64 characters; tells the camera apart in results and messages
  RigidTransform station_from_camera = RigidTransform::Identity();
  bool is_rough = false;  ///< the pose is by tape measure: to start a calibration from
  /// As calibrated. Nothing = as the device says, where a device can say it.
  std::optional<CameraIntrinsics> intrinsics;
};

}  // namespace instep
