#include "config/distinct_cameras.h"

#include <fmt/format.h>

#include <string>

namespace instep {
namespace {

bool is_both(const std::string& one, const std::string& other) {
  return !one.empty() && one == other;
}

/// Empty for the cameras of a simulation or a recording, which bring their own names.
std::string name_of(const CameraSettings& camera) {
  const CameraPlacement* placement = camera.placement();
  return placement == nullptr ? std::string() : placement->name;
}

/// What the two share that only one camera can have; empty if they can be told apart.
std::string shared_device(const OpenniSettings& one, const OpenniSettings& other) {
  if (one.serial.empty() || other.serial.empty()) {
    return "kind \"openni2\" too, and of several each needs a serial";
  }
  return one.serial == other.serial ? "the serial " + one.serial + " too" : "";
}

/// A socket takes one device, whatever its number; makers do give several the same number.
std::string shared_device(const V4l2Settings& one, const V4l2Settings& other) {
  if (is_both(one.bus_path, other.bus_path)) return "the bus_path " + one.bus_path + " too";
  const bool apart = !one.bus_path.empty() && !other.bus_path.empty();
  if (!is_both(one.serial, other.serial) || apart) return {};
  return "the serial " + one.serial + " too, and not each a bus_path";
}

std::string what_is_shared(const CameraSettings& one, const CameraSettings& other) {
  if (is_both(name_of(one), name_of(other))) return "the name " + name_of(one) + " too";
  if (one.kind != other.kind) return {};
  switch (one.kind) {
    case CameraKind::kSimulated:
      return "kind \"simulated\" too: one brings all cameras of [simulation]";
    case CameraKind::kRecording:
      return one.path == other.path ? "the path " + one.path.string() + " too" : "";
    case CameraKind::kOpenni:
      return shared_device(one.openni, other.openni);
    case CameraKind::kV4l2:
      return shared_device(one.v4l2, other.v4l2);
  }
  return {};
}

}  // namespace

void check_distinct_cameras(const std::vector<CameraSettings>& cameras,
                            const std::vector<unsigned>& lines, SettingsFaults& faults) {
  for (std::size_t i = 1; i < cameras.size(); ++i) {
    for (std::size_t before = 0; before < i; ++before) {
      const std::string shared = what_is_shared(cameras[before], cameras[i]);
      if (shared.empty()) continue;
      faults.add(lines[i], fmt::format("the [[camera]] of line {} has {}", lines[before], shared));
      break;
    }
  }
}

}  // namespace instep
