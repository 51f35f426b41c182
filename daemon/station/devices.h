#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "core/result.h"
#include "drivers/depth_camera.h"
#include "drivers/pedal.h"

namespace instep {

/// What the settings say is plugged in, opened.
struct Devices {
  std::vector<std::unique_ptr<DepthCamera>> cameras;
  std::optional<double> platform_height_mm;  ///< as the cameras' source says it
  std::string calibration;                   ///< where the cameras' poses come from
  bool simulated = false;
  std::map<std::string, double> truth;  ///< as Capture::truth
};

/// The one place that knows the camera families: a new one is a new case here. May take some
/// seconds (a simulated station builds its foot). Fails with what the family says; worth another
/// try later, since a camera that is away at boot may come.
Result<Devices> open_devices(const Settings& settings);

/// The pedal, or nullptr if the settings say that there is none.
Result<std::unique_ptr<Pedal>> open_pedal(const Settings& settings);

}  // namespace instep
