#pragma once

#include <string>
#include <vector>

#include "tests/kernel/devices/usb_depth_camera.h"

namespace instep::test {

/// A station of the one camera that UsbDepthCamera is by default. It is looked at only when
/// something happens.
inline std::string one_camera_settings() {
  return "[[camera]]\nkind = \"v4l2\"\nname = \"only\"\nserial = \"0001\"\ndepth_unit_mm = 1.0\n"
         "intrinsics = { width = 160, height = 120, fx = 140, fy = 140, cx = 79.5, cy = 59.5 }\n"
         "station_from_camera = [ 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 500, 0, 0, 0, 1 ]\n"
         "[capture]\ncheck_every_s = 3600\nframe_limit_ms = 300\n";
}

/// A wall at 500 units.
inline UsbDepthCamera::Scene flat_scene() {
  return [](std::uint32_t) { return std::vector<std::uint16_t>(160U * 120U, 500); };
}

}  // namespace instep::test
