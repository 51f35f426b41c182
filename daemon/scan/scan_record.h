#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/foot/foot_pair.h"
#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"
#include "core/foot/shoe_sizes.h"
#include "drivers/depth_camera.h"

namespace instep {

/// The two feet of one scan.
struct ScannedPair {
  std::string left_id;
  std::string right_id;
  FootPair feet;
  ShoeSizes sizes;  ///< for shoes that take the larger foot, in each measure
};

/// One measured foot with all that is told about how it came to be: what result.json holds.
struct ScanRecord {
  std::string id;                              ///< sortable by time, says nothing about the person
  std::chrono::system_clock::time_point time;  ///< at which it was measured
  std::string station;
  std::vector<CameraDescription> devices;
  std::string calibration;  ///< where the cameras' poses come from
  bool simulated = false;
  std::map<std::string, double> timings_ms;  ///< stage -> milliseconds
  std::map<std::string, double> quality;     ///< figure -> value, names carry their unit
  std::vector<std::string> warnings;         ///< of the scan as a whole
  std::map<std::string, double> truth;       ///< of a simulated foot: measure id -> value

  FootScan foot;
  MeasureSet measures;
  ShoeSizes sizes;
  std::optional<ScannedPair> pair;  ///< if the scan gave a left and a right foot
};

}  // namespace instep
