#include "core/fusion/frames/deprojector.h"

#include "core/fusion/frames/lens.h"

namespace instep {

Result<Deprojector> Deprojector::create(const CameraIntrinsics& intrinsics) {
  if (auto sound = check_intrinsics(intrinsics); !sound) {
    return tl::make_unexpected(sound.error());
  }
  Deprojector deprojector;
  deprojector.intrinsics_ = intrinsics;
  const auto pixels =
      static_cast<std::size_t>(intrinsics.width) * static_cast<std::size_t>(intrinsics.height);
  deprojector.x_.reserve(pixels);
  deprojector.y_.reserve(pixels);
  Eigen::Vector2d row_start = Eigen::Vector2d::Zero();
  for (int v = 0; v < intrinsics.height; ++v) {
    Eigen::Vector2d ideal = row_start;
    for (int u = 0; u < intrinsics.width; ++u) {
      const Eigen::Vector2d bent = distorted_at(intrinsics, u, v);
      const auto solved = undistorted(intrinsics, bent, u + v == 0 ? bent : ideal);
      if (!solved) {
        return fail(ErrorCode::kInvalidInput, "the distortion folds the image",
                    "correct the camera's calibration");
      }
      ideal = *solved;
      if (u == 0) row_start = ideal;
      deprojector.x_.push_back(static_cast<float>(ideal.x()));
      deprojector.y_.push_back(static_cast<float>(ideal.y()));
    }
  }
  return deprojector;
}

}  // namespace instep
