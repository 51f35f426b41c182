#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fusion/frames/depth_frame.h"
#include "core/result.h"

namespace instep {

/// The ray of every pixel of a camera, computed once, so that a pixel of a depth image becomes a
/// point by one multiplication: its depth along the ray, in the camera frame.
///
/// Rays are floats: 1 m along one the rounding is 0.0001 mm.
/// Building a 640x480 table costs some 2 ms without distortion and 20 ms with; keep it for the life
/// of the camera. Immutable, safe to share between threads.
class Deprojector {
 public:
  /// Fails as check_intrinsics() does.
  static Result<Deprojector> create(const CameraIntrinsics& intrinsics);

  const CameraIntrinsics& intrinsics() const { return intrinsics_; }

  /// Direction of a pixel's ray, scaled to z = 1.
  Eigen::Vector3f ray(std::size_t pixel) const { return {x_[pixel], y_[pixel], 1.0F}; }

 private:
  Deprojector() = default;

  CameraIntrinsics intrinsics_;
  std::vector<float> x_;
  std::vector<float> y_;
};

}  // namespace instep
