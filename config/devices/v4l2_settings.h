#pragma once

#include <string>
#include <vector>

#include "config/poses/camera_placement.h"

namespace instep {

enum class V4l2Format { kZ16, kY16, kInzi };

/// A depth camera that the kernel serves as /dev/videoN. What V4L2 does not tell has no default and
/// must be set: the unit of depth, the lens, the pose.
struct V4l2Settings {
  CameraPlacement placement;  ///< its intrinsics are there, and have the size of the images
  /// One of the two at least; both must fit where both are set.
  std::string serial;    ///< 1 to 64 characters
  std::string bus_path;  ///< such as "usb-0000:00:14.0-2.3"; 1 to 128 characters
  V4l2Format format = V4l2Format::kZ16;
  double depth_unit_mm = 0.0;  ///< is_depth_unit()

  struct Control {
    std::string name;
    int value = 0;
  };
  std::vector<Control> controls;  ///< in the order in which they are set, at most 32
};

/// The lines of `instepd --check` say it so.
std::string describe(const V4l2Settings& settings);

}  // namespace instep
