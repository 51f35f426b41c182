#include "daemon/machine/inventory.h"

#include <utility>

#include "drivers/usb/usb_devices.h"

namespace instep {
namespace {

std::string camera_of(const Settings& settings, const UsbDevice& device) {
  for (const auto& camera : settings.cameras) {
    if (camera.kind != CameraKind::kV4l2) continue;
    if (device.is_meant_by({camera.v4l2.bus_path, camera.v4l2.serial})) {
      return camera.v4l2.placement.name;
    }
  }
  return {};
}

void add_video_cameras(const Settings& settings, const DeviceFolders& folders, VideoSystem& system,
                       std::vector<PluggedCamera>& cameras) {
  for (const auto& node : list_video_nodes(folders)) {
    if (cameras.empty() || cameras.back().device.address != node.device.address) {
      cameras.push_back({"v4l2", node.device, {}, {}, camera_of(settings, node.device)});
    }
    cameras.back().nodes.push_back(node.path);
    auto modes = list_video_modes(system, node.path);
    if (!modes) continue;
    for (auto& mode : *modes) cameras.back().modes.push_back(std::move(mode));
  }
}

void add_openni_sensors(const DeviceFolders& folders, std::vector<PluggedCamera>& cameras) {
  for (auto& plugged : list_usb_devices(folders.sysfs, folders.dev)) {
    if (!is_openni_sensor(plugged.vendor)) continue;
    cameras.push_back({"openni2", std::move(plugged.device), {std::move(plugged.node)}, {}, {}});
  }
}

}  // namespace

Inventory take_inventory(const Settings& settings, const DeviceFolders& folders,
                         VideoSystem& system) {
  Inventory inventory;
  add_video_cameras(settings, folders, system, inventory.cameras);
  add_openni_sensors(folders, inventory.cameras);
  inventory.gpio_chips = list_gpio_chips(folders.dev);
  inventory.foot_switches = list_input_nodes(folders.sysfs, folders.dev);
  return inventory;
}

bool is_pedal(const PedalSettings& pedal, const GpioChipState& chip, const GpioLineState& line) {
  if (pedal.kind != PedalKind::kGpio) return false;
  if (!pedal.gpio.chip.empty() && pedal.gpio.chip != chip.label) return false;
  if (!pedal.gpio.line.empty()) return pedal.gpio.line == line.name;
  return pedal.gpio.offset && static_cast<unsigned>(*pedal.gpio.offset) == line.offset;
}

bool is_pedal(const PedalSettings& pedal, const InputNode& node) {
  if (pedal.kind != PedalKind::kEvdev) return false;
  const std::string name = std::filesystem::path(pedal.evdev.device).filename();
  return pedal.evdev.device == node.ids || (!node.by_id.empty() && name == node.by_id);
}

bool is_openni_sensor(const std::string& usb_vendor) {
  constexpr const char* kPrimeSense = "1d27";
  constexpr const char* kOrbbec = "2bc5";
  return usb_vendor == kPrimeSense || usb_vendor == kOrbbec;
}

}  // namespace instep
