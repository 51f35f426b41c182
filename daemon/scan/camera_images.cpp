#include "daemon/scan/camera_images.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "daemon/scan/all_processors.h"

namespace instep {
namespace {

/// `last`: why its last frame was of no use; nothing if it gave none.
tl::unexpected<Error> no_usable_frame(const std::string& camera, const std::optional<Error>& last) {
  const std::string none = "camera " + camera + " gave no usable frame";
  return last ? fail(ErrorCode::kInsufficientData, none + ": " + last->message,
                     last->advice + ", then scan again")
              : fail(ErrorCode::kInsufficientData, none,
                     "check that it is plugged in, then scan again");
}

/// The frames of one camera as one depth image. A camera without a good frame fails the scan: a set
/// that is not whole is never measured as if it were.
Result<FusedDepth> fuse_camera(const Capture& capture, const CameraDescription& camera,
                               const GoOn& go_on) {
  const auto is_own = [&camera](const DepthFrame& frame) {
    return frame.camera == camera.geometry.id;
  };
  TemporalSettings settings;
  settings.expected_frames =
      static_cast<int>(std::count_if(capture.frames.begin(), capture.frames.end(), is_own));
  TemporalFusion fusion(settings);
  std::optional<Error> rejected;
  for (const auto& frame : capture.frames) {
    if (!is_own(frame)) continue;
    // A rejected frame is counted, and the count is part of the result's quality.
    if (const auto added = fusion.add(frame); !added) rejected = added.error();
    if (!go_on()) return cancelled();
  }
  if (fusion.frames_used() == 0) return no_usable_frame(camera.geometry.id, rejected);
  return fusion.result();
}

}  // namespace

Result<std::vector<FusedDepth>> camera_images(const Capture& capture, const GoOn& go_on) {
  std::vector<std::optional<Result<FusedDepth>>> fused(capture.cameras.size());
  on_all_processors(fused.size(), [&](std::size_t i) {
    fused[i] = fuse_camera(capture, capture.cameras[i], go_on);
  });
  std::vector<FusedDepth> images;
  for (auto& image : fused) {
    if (!*image) return tl::make_unexpected(image->error());
    images.push_back(std::move(**image));
  }
  return images;
}

std::vector<std::string> rejection_warnings(const std::vector<FusedDepth>& images) {
  std::vector<std::string> warnings;
  for (const auto& image : images) {
    if (image.frames_rejected <= image.frames_used) continue;
    warnings.push_back(fmt::format(
        "{} of {} frames of camera {} were of no use: check its cable, that nothing covers it, and "
        "its depth_unit_mm",
        image.frames_rejected, image.frames_rejected + image.frames_used, image.camera));
  }
  return warnings;
}

std::vector<View> views_of(const Capture& capture, std::vector<FusedDepth> images) {
  std::vector<View> views;
  for (std::size_t i = 0; i < images.size(); ++i) {
    views.push_back({capture.cameras[i].geometry, std::move(images[i]), nullptr});
  }
  return views;
}

}  // namespace instep
