#include "sim/openni2_module/sensor_modes.h"

namespace instep {

std::vector<OniVideoMode> sensor_modes(const BusDevice& device) {
  constexpr int kFramesPerSecond = 30;
  std::vector<OniVideoMode> modes;
  for (const int part : {2, 1}) {
    const int width = device.width / part;
    const int height = device.height / part;
    modes.push_back({ONI_PIXEL_FORMAT_DEPTH_1_MM, width, height, kFramesPerSecond});
    if (device.unit_um != 100) continue;
    modes.push_back({ONI_PIXEL_FORMAT_DEPTH_100_UM, width, height, kFramesPerSecond});
  }
  return modes;
}

}  // namespace instep
