#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "core/foot/side.h"
#include "core/result.h"
#include "drivers/depth_camera.h"
#include "drivers/pedal.h"

namespace instep {

/// The measures of one simulated body, known from its shape: measure id -> value.
struct KnownTruth {
  std::optional<Side> side;  ///< nothing = not a foot
  std::map<std::string, double> measures;
};

/// What the settings say is plugged in, opened.
struct Devices {
  std::vector<std::unique_ptr<DepthCamera>> cameras;
  std::optional<double> platform_height_mm;  ///< as the cameras' source says it
  std::string calibration;                   ///< where the cameras' poses come from
  bool simulated = false;
  std::vector<KnownTruth> truth;  ///< of simulated bodies
};

/// The one place that knows the camera families: a new one is a new case here. May take some
/// seconds (a simulated station builds its foot). Fails with what the family says; worth another
/// try later, since a camera that is away at boot may come.
Result<Devices> open_devices(const Settings& settings);

/// The pedal, or nullptr if the settings say that there is none.
Result<std::unique_ptr<Pedal>> open_pedal(const Settings& settings);

}  // namespace instep
