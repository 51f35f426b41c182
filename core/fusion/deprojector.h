#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fusion/depth_frame.h"
#include "core/result.h"

namespace instep {

/// The ray of every pixel of a camera, computed once, so that a depth image becomes points by one
/// multiplication each.
///
/// Points are floats in the camera frame, in millimetres: at 1 m the rounding is 0.0001 mm.
/// Building a 640x480 table costs some 2 ms without distortion and 20 ms with; keep it for the life
/// of the camera. Immutable, safe to share between threads.
class Deprojector {
 public:
  /// Fails as check_intrinsics() does.
  static Result<Deprojector> create(const CameraIntrinsics& intrinsics);

  const CameraIntrinsics& intrinsics() const { return intrinsics_; }

  /// Direction of a pixel's ray, scaled to z = 1.
  Eigen::Vector3f ray(std::size_t pixel) const { return {x_[pixel], y_[pixel], 1.0F}; }

  /// One point a pixel; a pixel without data becomes the origin. `depth_mm` holds one value a
  /// pixel, row by row; any other number of values gives no points. `points` is resized, and
  /// reused if it has the size already. Under 2 ms for 640x480.
  void deproject(const std::vector<float>& depth_mm, std::vector<Eigen::Vector3f>& points) const;

 private:
  Deprojector() = default;

  CameraIntrinsics intrinsics_;
  std::vector<float> x_;
  std::vector<float> y_;
};

}  // namespace instep
