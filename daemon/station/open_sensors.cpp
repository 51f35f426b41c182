#include "daemon/station/open_sensors.h"

#include <algorithm>
#include <utility>

namespace instep {

void OpenSensors::keep(const Settings& settings, Devices devices) {
  sensors_.clear();
  for (const auto& source : settings.cameras) {
    if (source.kind != CameraKind::kOpenni) continue;
    const std::string& name = source.openni.placement.name;
    const auto camera = std::find_if(
        devices.cameras.begin(), devices.cameras.end(),
        [&](const auto& one) { return one && one->description().geometry.id == name; });
    if (camera == devices.cameras.end()) continue;
    OpenSensor& sensor = sensors_[name];
    sensor.camera = std::move(*camera);
    if (const auto usb = devices.usb.find(name); usb != devices.usb.end()) sensor.usb = usb->second;
  }
}

std::optional<OpenSensor> OpenSensors::take(const std::string& name) {
  auto kept = sensors_.extract(name);
  if (!kept) return std::nullopt;
  return std::move(kept.mapped());
}

}  // namespace instep
