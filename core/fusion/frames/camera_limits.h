#pragma once

#include <optional>
#include <string>

#include "core/geometry/point_cloud.h"
#include "core/geometry/rigid_transform.h"

namespace instep {

/// What a depth camera can be, wherever its numbers come from: settings, a recording or a sensor.
/// What one of them takes and another refuses fails late, and for a reason that is none.

/// In pixels.
inline constexpr int kSmallestImageSide = 16;
inline constexpr int kLargestImageSide = 8192;

/// What a raw depth of 1 may be worth.
inline constexpr double kSmallestDepthUnitMm = 1e-3;
inline constexpr double kLargestDepthUnitMm = 100.0;
bool is_depth_unit(double millimetres);

/// No camera of a station stands further from its origin, along any axis: whoever writes more did
/// not write millimetres.
inline constexpr double kFarthestCameraMm = kLargestCoordinateMm;

/// Why no camera stands so, as what follows the name of the pose in a sentence; nothing if one may.
std::optional<std::string> fault_of_pose(const Eigen::Matrix4d& station_from_camera);

}  // namespace instep
