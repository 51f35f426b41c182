#include "core/fusion/frames/camera_limits.h"

namespace instep {

bool is_depth_unit(double millimetres) {
  return millimetres >= kSmallestDepthUnitMm && millimetres <= kLargestDepthUnitMm;
}

std::optional<std::string> fault_of_pose(const Eigen::Matrix4d& station_from_camera) {
  if (!is_rigid(station_from_camera)) {
    return "is no rotation and shift (rows of a rigid 4x4 matrix, the last of them 0, 0, 0, 1)";
  }
  if (station_from_camera.topRightCorner<3, 1>().cwiseAbs().maxCoeff() <= kFarthestCameraMm) {
    return std::nullopt;
  }
  constexpr int kMetres = static_cast<int>(kFarthestCameraMm / 1000.0);
  return "puts the camera more than " + std::to_string(kMetres) + " m away (write millimetres)";
}

}  // namespace instep
