#include "core/fusion/frames/depth_frame.h"

#include <algorithm>
#include <cmath>

#include "core/fusion/frames/camera_limits.h"
#include "core/fusion/frames/lens.h"

namespace instep {
namespace {

constexpr int kProbesOnASide = 16;  // a fold shows along the image border first, and between

bool sound_focal(double focal, int width) {
  return std::isfinite(focal) && focal >= 0.1 * width && focal <= 100.0 * width;
}

bool sound_centre(double centre, int side) {
  return std::isfinite(centre) && centre >= -1.0 * side && centre <= 2.0 * side;
}

/// Walks from the middle of the image, where a lens distorts least, to a pixel, each step starting
/// where the last one ended: a fold on the way is met and not jumped over.
bool unfolds(const CameraIntrinsics& intrinsics, double u, double v) {
  const Eigen::Vector2d target = distorted_at(intrinsics, u, v);
  Eigen::Vector2d ideal = Eigen::Vector2d::Zero();
  for (int step = 1; step <= kProbesOnASide; ++step) {
    const auto next = undistorted(intrinsics, target * (1.0 * step / kProbesOnASide), ideal);
    if (!next) return false;
    ideal = *next;
  }
  return true;
}

bool unfolds(const CameraIntrinsics& intrinsics) {
  for (int i = 0; i <= kProbesOnASide; ++i) {
    const double u = (intrinsics.width - 1.0) * i / kProbesOnASide;
    const double v = (intrinsics.height - 1.0) * i / kProbesOnASide;
    if (!unfolds(intrinsics, u, 0) || !unfolds(intrinsics, u, intrinsics.height - 1.0) ||
        !unfolds(intrinsics, 0, v) || !unfolds(intrinsics, intrinsics.width - 1.0, v)) {
      return false;
    }
  }
  return true;
}

tl::unexpected<Error> bad_lens(const std::string& what) {
  return fail(ErrorCode::kInvalidInput, what, "correct the camera's calibration");
}

}  // namespace

Result<void> check_intrinsics(const CameraIntrinsics& intrinsics) {
  const auto [smaller, larger] = std::minmax(intrinsics.width, intrinsics.height);
  if (smaller < kSmallestImageSide || larger > kLargestImageSide) {
    return bad_lens("the image size " + std::to_string(intrinsics.width) + " x " +
                    std::to_string(intrinsics.height) + " is outside " +
                    std::to_string(kSmallestImageSide) + " to " +
                    std::to_string(kLargestImageSide) + " pixels");
  }
  if (!sound_focal(intrinsics.fx, intrinsics.width) ||
      !sound_focal(intrinsics.fy, intrinsics.width)) {
    return bad_lens("a focal length is no number or outside 0.1 to 100 image widths");
  }
  if (!sound_centre(intrinsics.cx, intrinsics.width) ||
      !sound_centre(intrinsics.cy, intrinsics.height)) {
    return bad_lens("the principal point is no number or far outside the image");
  }
  const auto& distortion = intrinsics.distortion;
  if (!std::all_of(distortion.begin(), distortion.end(),
                   [](double k) { return std::isfinite(k); })) {
    return bad_lens("a distortion coefficient is no number");
  }
  if (!unfolds(intrinsics)) return bad_lens("the distortion folds the image");
  return {};
}

}  // namespace instep
