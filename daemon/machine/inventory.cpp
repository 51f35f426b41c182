#include "daemon/machine/inventory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <set>
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

/// That a user may not open a node, or that it has just left, is no trouble of the camera's.
void note_trouble(const Error& error, PluggedCamera& camera) {
  const bool is_its_own =
      error.code != ErrorCode::kPermissionDenied && error.code != ErrorCode::kNotFound;
  if (is_its_own) camera.trouble = error.message;
}

void add_video_cameras(const Settings& settings, const DeviceFolders& folders, VideoSystem& system,
                       std::vector<PluggedCamera>& cameras) {
  for (const auto& node : list_video_nodes(folders)) {
    if (cameras.empty() || cameras.back().device.address != node.device.address) {
      cameras.push_back({"v4l2", node.device, {}, {}, camera_of(settings, node.device), {}});
    }
    cameras.back().nodes.push_back(node.path);
    auto modes = list_video_modes(system, node.path);
    if (!modes) {
      note_trouble(modes.error(), cameras.back());
      continue;
    }
    for (auto& mode : *modes) cameras.back().modes.push_back(std::move(mode));
  }
}

/// Of "1d27/0609@1/12", as OpenNI2's own driver names places on USB: /dev/bus/usb/001/012. Empty
/// for the places of other drivers.
std::filesystem::path usb_node(const std::string& uri, const std::filesystem::path& dev) {
  unsigned bus = 0;
  unsigned number = 0;
  if (std::sscanf(uri.c_str(), "%*4[0-9a-fA-F]/%*4[0-9a-fA-F]@%3u/%3u", &bus, &number) != 2) {
    return {};
  }
  return dev / fmt::format("bus/usb/{:03}/{:03}", bus, number);
}

/// A line for each depth unit, with the sizes of its images.
std::vector<VideoModes> modes_of(const OpenniDevice& sensor) {
  std::vector<VideoModes> modes;
  for (const auto& mode : sensor.modes) {
    const std::string unit = fmt::format("{} mm", mode.depth_unit_mm);
    const std::string size = fmt::format("{}x{}", mode.width, mode.height);
    auto same =
        std::find_if(modes.begin(), modes.end(), [&](auto& one) { return one.format == unit; });
    if (same == modes.end()) same = modes.insert(modes.end(), {unit, {}});
    auto& sizes = same->sizes;
    if (std::find(sizes.begin(), sizes.end(), size) == sizes.end()) sizes.push_back(size);
  }
  return modes;
}

void note(const OpenniDevice& sensor, PluggedCamera& camera) {
  auto& [address, product, link_mbps, could_be_faster] = camera.device;
  if (product.empty()) product = sensor.vendor + " " + sensor.product;
  if (!sensor.serial.empty()) address.serial = sensor.serial;
  camera.modes = modes_of(sensor);
  camera.trouble = sensor.trouble;
}

/// Those that the kernel shows by their maker, and whatever else OpenNI2 sees.
std::vector<PluggedCamera> openni_sensors(const DeviceFolders& folders, const OpenniSight& openni) {
  std::vector<PluggedCamera> cameras;
  std::set<const OpenniDevice*> told;
  for (auto& plugged : list_usb_devices(folders.sysfs, folders.dev)) {
    const auto seen = std::find_if(
        openni.sensors.begin(), openni.sensors.end(),
        [&](const auto& sensor) { return usb_node(sensor.uri, folders.dev) == plugged.node; });
    if (seen == openni.sensors.end() && !is_openni_sensor(plugged.vendor)) continue;
    cameras.push_back({"openni2", std::move(plugged.device), {plugged.node}, {}, {}, {}});
    if (seen != openni.sensors.end()) {
      note(*seen, cameras.back());
      told.insert(&*seen);
    }
  }
  for (const auto& sensor : openni.sensors) {
    if (told.contains(&sensor)) continue;
    cameras.push_back({"openni2", {}, {}, {}, {}, {}});
    note(sensor, cameras.back());
  }
  return cameras;
}

/// A [[camera]] without a serial means the only sensor there is.
void name_configured(const Settings& settings, std::vector<PluggedCamera>& sensors) {
  for (auto& sensor : sensors) {
    for (const auto& camera : settings.cameras) {
      if (camera.kind != CameraKind::kOpenni) continue;
      const auto& wanted = camera.openni.serial;
      const bool meant =
          wanted.empty() ? sensors.size() == 1 : wanted == sensor.device.address.serial;
      if (meant) sensor.configured_as = camera.openni.placement.name;
    }
  }
}

}  // namespace

OpenniSight look_through_openni(const Settings& settings, const std::filesystem::path& program,
                                std::chrono::milliseconds limit) {
  std::set<std::filesystem::path> libraries{""};
  for (const auto& camera : settings.cameras) libraries.insert(camera.openni.library_folder);
  OpenniSight sight;
  std::set<std::string> places;
  for (const auto& library : libraries) {
    const auto listed = list_openni_devices({program, library}, limit);
    if (!listed) {
      sight.troubles.push_back(listed.error());
      continue;
    }
    for (const auto& sensor : *listed) {
      if (places.insert(sensor.uri).second) sight.sensors.push_back(sensor);
    }
  }
  return sight;
}

Inventory take_inventory(const Settings& settings, const DeviceFolders& folders,
                         VideoSystem& system, const OpenniSight& openni) {
  Inventory inventory;
  add_video_cameras(settings, folders, system, inventory.cameras);
  auto sensors = openni_sensors(folders, openni);
  name_configured(settings, sensors);
  std::move(sensors.begin(), sensors.end(), std::back_inserter(inventory.cameras));
  inventory.openni_troubles = openni.troubles;
  inventory.gpio_chips = list_gpio_chips(folders.dev);
  inventory.foot_switches = list_input_nodes(folders.sysfs, folders.dev);
  return inventory;
}

std::string use_of_line(const Settings& settings, const GpioChipState& chip,
                        const GpioLineState& line) {
  const auto is_it = [&](const GpioPlace& place) {
    return place.is(chip.label, line.name, line.offset);
  };
  if (settings.pedal.kind == PedalKind::kGpio && is_it(settings.pedal.gpio.place)) return "pedal";
  for (const auto& [name, output] : settings.outputs.named()) {
    if (is_it(output->place)) return name;
  }
  return {};
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
