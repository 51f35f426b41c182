#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "drivers/v4l2/video_system.h"

namespace instep {

/// What a video node can send: a format's four letters with the sizes it comes in.
struct VideoModes {
  std::string format;              ///< such as "Z16"
  std::vector<std::string> sizes;  ///< such as "640x480"; empty where the driver takes any size
};

/// All that the node `path` offers, as the driver lists it; empty for a node that sends no images.
/// Opens the node and disturbs no one who streams from it. Fails with kPermissionDenied or
/// kNotFound, as video_error() where it cannot be opened for another reason, and with kDeviceGone
/// or kIo if the list ends before its time.
Result<std::vector<VideoModes>> list_video_modes(VideoSystem& system,
                                                 const std::filesystem::path& path);

}  // namespace instep
