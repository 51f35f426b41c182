#include "drivers/v4l2/video_modes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <cstring>

#include "drivers/v4l2/depth_format.h"
#include "drivers/v4l2/video_call.h"

namespace instep {
namespace {

std::vector<std::string> sizes_of(VideoSystem& system, int node, std::uint32_t format) {
  std::vector<std::string> sizes;
  v4l2_frmsizeenum size{};
  size.pixel_format = format;
  for (; size.index < kMostListed; ++size.index) {
    if (video_call(system, node, VIDIOC_ENUM_FRAMESIZES, &size) != 0) break;
    if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) break;
    sizes.push_back(fmt::format("{}x{}", size.discrete.width, size.discrete.height));
  }
  return sizes;
}

}  // namespace

Result<std::vector<VideoModes>> list_video_modes(VideoSystem& system,
                                                 const std::filesystem::path& path) {
  const int node = system.open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (node < 0) {
    const bool denied = errno == EACCES || errno == EPERM;
    return fail(denied ? ErrorCode::kPermissionDenied : ErrorCode::kNotFound,
                fmt::format("{} cannot be opened: {}", path.string(), std::strerror(errno)),
                denied ? "sudo usermod -aG video $USER, then log in again" : "plug it in again");
  }
  std::vector<VideoModes> modes;
  v4l2_fmtdesc format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (; format.index < kMostListed; ++format.index) {
    if (video_call(system, node, VIDIOC_ENUM_FMT, &format) != 0) break;
    modes.push_back(
        {to_string_of_four(format.pixelformat), sizes_of(system, node, format.pixelformat)});
  }
  system.close(node);
  return modes;
}

}  // namespace instep
