#include "drivers/v4l2/video_modes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "drivers/files/node_error.h"
#include "drivers/files/system_user.h"
#include "drivers/v4l2/depth_format.h"
#include "drivers/v4l2/video_call.h"
#include "drivers/v4l2/video_error.h"

namespace instep {
namespace {

/// Takes one entry of a list of the driver's. False at its end, which EINVAL is, or ENOTTY of a
/// driver that has no such list.
Result<bool> takes_next(VideoSystem& system, int node, unsigned long request, void* entry) {
  if (video_call(system, node, request, entry) == 0) return true;
  if (errno == EINVAL || errno == ENOTTY) return false;
  return tl::make_unexpected(video_error(errno, "listing what it sends"));
}

Result<std::vector<std::string>> sizes_of(VideoSystem& system, int node, std::uint32_t format) {
  std::vector<std::string> sizes;
  v4l2_frmsizeenum size{};
  size.pixel_format = format;
  for (; size.index < kMostListed; ++size.index) {
    const auto taken = takes_next(system, node, VIDIOC_ENUM_FRAMESIZES, &size);
    if (!taken) return tl::make_unexpected(taken.error());
    if (!*taken || size.type != V4L2_FRMSIZE_TYPE_DISCRETE) break;
    sizes.push_back(fmt::format("{}x{}", size.discrete.width, size.discrete.height));
  }
  return sizes;
}

Result<std::vector<VideoModes>> modes_of(VideoSystem& system, int node) {
  std::vector<VideoModes> modes;
  v4l2_fmtdesc format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (; format.index < kMostListed; ++format.index) {
    const auto taken = takes_next(system, node, VIDIOC_ENUM_FMT, &format);
    if (!taken) return tl::make_unexpected(taken.error());
    if (!*taken) break;
    auto sizes = sizes_of(system, node, format.pixelformat);
    if (!sizes) return tl::make_unexpected(sizes.error());
    modes.push_back({to_string_of_four(format.pixelformat), std::move(*sizes)});
  }
  return modes;
}

Error not_opened(int error_number, const std::filesystem::path& path) {
  return node_error(error_number, path, command_to_join("video") + ", then log in again",
                    "plug it in again")
      .value_or(video_error(error_number, "opening " + path.string()));
}

}  // namespace

Result<std::vector<VideoModes>> list_video_modes(VideoSystem& system,
                                                 const std::filesystem::path& path) {
  const int node = system.open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (node < 0) return tl::make_unexpected(not_opened(errno, path));
  auto modes = modes_of(system, node);
  system.close(node);
  return modes;
}

}  // namespace instep
