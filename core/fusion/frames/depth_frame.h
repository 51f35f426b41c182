#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/rigid_transform.h"
#include "core/result.h"

namespace instep {

/// A pinhole with Brown-Conrady distortion. Pixel (u, v) is its centre, with integer u and v.
/// Camera frame: x right, y down, z forward.
struct CameraIntrinsics {
  int width = 0;
  int height = 0;
  double fx = 0.0;  ///< focal lengths and principal point in pixels
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  /// k1, k2, p1, p2, k3: acts on normalised coordinates, from ideal to distorted.
  std::array<double, 5> distortion{};
};

/// Fails with kInvalidInput on what no camera has: sizes beyond camera_limits.h, focal lengths that
/// are not finite or outside a tenth to a hundred times the width, a principal point further than
/// one image size outside the image, distortion that is not finite or folds the image.
Result<void> check_intrinsics(const CameraIntrinsics& intrinsics);

/// A camera as the fusion needs it: its lens and where it stands.
///
/// Station frame: right-handed, in millimetres, z up; its origin is in the middle of the platform,
/// x points to where the customer looks, y to the customer's left. The standing surface is level:
/// at the height that settings or recording give it, else where the views show it; a calibration
/// puts it at 0 if none is given. No measure depends on where x and y point, nor on the origin as
/// long as the feet are within 600 mm of it: what is not is background.
struct CameraGeometry {
  std::string id;
  CameraIntrinsics intrinsics;
  RigidTransform station_from_camera = RigidTransform::Identity();
};

/// How a frame came out of its camera. Only kGood frames are fused; the others are counted.
enum class FrameStatus {
  kGood,
  kCorrupt,     ///< flagged by the driver, or its content contradicts its format
  kIncomplete,  ///< fewer pixels than the format says
  kStale,       ///< from before the stream began, or seen already
};

/// One depth image as it left the camera. Depth is kept in the camera's own integers.
struct DepthFrame {
  std::string camera;  ///< CameraGeometry::id
  std::uint64_t sequence = 0;
  int width = 0;
  int height = 0;
  double depth_unit_mm = 1.0;                ///< millimetres in one unit of `raw`
  std::vector<std::uint16_t> raw;            ///< width * height values, row by row; 0 = no data
  std::chrono::microseconds device_time{0};  ///< the camera's own clock
  std::chrono::steady_clock::time_point host_time{};  ///< when it reached this machine
  FrameStatus status = FrameStatus::kGood;
};

}  // namespace instep
