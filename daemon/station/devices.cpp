#include "daemon/station/devices.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <utility>

#include "config/calibration/source_of_poses.h"
#include "config/settings_search.h"
#include "daemon/machine/inventory.h"
#include "daemon/station/open_sensors.h"
#include "drivers/evdev/evdev_pedal.h"
#include "drivers/gpio/gpio_output.h"
#include "drivers/gpio/gpio_pedal.h"
#include "drivers/openni2/openni_camera.h"
#include "drivers/recording/recording_camera.h"
#include "drivers/recording/recording_reader.h"
#include "drivers/usb/usb_devices.h"
#include "drivers/v4l2/v4l2_camera.h"
#include "sim/fault_script.h"
#include "sim/simulated_pedal.h"
#include "sim/simulated_station.h"

namespace instep {
namespace {

Subject subject_of(SimulatedSubject subject) {
  switch (subject) {
    case SimulatedSubject::kFoot:
      return Subject::kFoot;
    case SimulatedSubject::kFeet:
      return Subject::kFeet;
    case SimulatedSubject::kCylinder:
      return Subject::kCylinder;
    case SimulatedSubject::kLast:
      return Subject::kLast;
  }
  return Subject::kFoot;
}

NoiseLaw noise_of(SimulatedNoise noise) {
  switch (noise) {
    case SimulatedNoise::kNone:
      return NoiseLaw::kNone;
    case SimulatedNoise::kTypical:
      return NoiseLaw::kTypical;
    case SimulatedNoise::kPessimistic:
      return NoiseLaw::kPessimistic;
  }
  return NoiseLaw::kTypical;
}

Result<std::string> read_fault_script(const std::filesystem::path& path) {
  if (path.empty()) return std::string();
  constexpr std::streamsize kLargestScript = 64 * 1024;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    return fail(ErrorCode::kNotFound, "the fault script " + path.string() + " cannot be read",
                "check simulation.fault_script");
  }
  std::string text(static_cast<std::size_t>(kLargestScript), '\0');
  stream.read(text.data(), kLargestScript);
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

Result<void> add_simulated(const SimulatedStationSettings& chosen, Devices& devices) {
  auto script = read_fault_script(chosen.fault_script);
  if (!script) return tl::make_unexpected(script.error());
  SimulationSettings settings;
  settings.seed = chosen.seed;
  settings.subject = subject_of(chosen.subject);
  settings.side = chosen.side;
  settings.cameras = chosen.cameras;
  settings.width_px = chosen.width_px;
  settings.height_px = chosen.height_px;
  settings.noise = noise_of(chosen.noise);
  settings.pacing =
      chosen.pacing == SimulatedPacing::kRealTime ? Pacing::kRealTime : Pacing::kAsFastAsPossible;
  settings.fault_script = std::move(*script);
  auto station = build_station(settings);
  if (!station) return tl::make_unexpected(station.error());
  for (auto& camera : station->cameras) devices.cameras.push_back(std::move(camera));
  if (chosen.truth) {
    devices.work_out_truth = [scene = station->scene] {
      return subjects_truth(scene).map(truth_by_id);
    };
  }
  devices.platform_height_mm = station->platform_height_mm;
  devices.calibration = "simulated: exact poses";
  devices.simulated = true;
  return {};
}

Result<void> add_recording(const std::filesystem::path& folder, Devices& devices) {
  auto read = read_recording(folder);
  if (!read) return tl::make_unexpected(read.error());
  const auto recording = std::make_shared<const Recording>(std::move(*read));
  for (const auto& description : recording->cameras) {
    auto camera = RecordingCamera::open(recording, description.geometry.id,
                                        {.as_recorded = false, .loop = true});
    if (!camera) return tl::make_unexpected(camera.error());
    devices.cameras.push_back(std::move(*camera));
  }
  devices.platform_height_mm = recording->platform_height_mm;
  if (!recording->truth.empty()) {
    devices.work_out_truth = [truth = recording->truth] { return truth; };
  }
  devices.calibration = "as the recording says";
  devices.simulated = devices.simulated || recording->simulated;
  return {};
}

Result<OpenSensor> open_openni(const OpenniSettings& chosen, OpenSensors& kept) {
  auto usb = usb_address_of(chosen, {});
  if (auto still = kept.take(chosen.placement.name)) {
    if (usb) still->usb = usb;
    return std::move(*still);
  }
  OpenniCamera::Settings settings;
  settings.name = chosen.placement.name;
  settings.serial = chosen.serial;
  settings.station_from_camera = chosen.placement.station_from_camera;
  settings.intrinsics = chosen.placement.intrinsics;
  settings.program = {running_program_folder() / "instep-openni", chosen.library_folder};
  auto camera = OpenniCamera::open(std::move(settings));
  if (!camera) {
    Error error = camera.error();
    error.message = "camera " + chosen.placement.name + ": " + error.message;
    return tl::make_unexpected(error);
  }
  return OpenSensor{std::move(*camera), usb};
}

/// `kept`: those that are open still.
Result<void> add_openni(const OpenniSettings& chosen, OpenSensors& kept, Devices& devices) {
  auto sensor = open_openni(chosen, kept);
  if (!sensor) return tl::make_unexpected(sensor.error());
  devices.simulated = devices.simulated || sensor->camera->description().simulated;
  if (sensor->usb) devices.usb[chosen.placement.name] = *sensor->usb;
  devices.cameras.push_back(std::move(sensor->camera));
  return {};
}

DepthFormat format_of(V4l2Format format) {
  switch (format) {
    case V4l2Format::kZ16:
      return DepthFormat::kZ16;
    case V4l2Format::kY16:
      return DepthFormat::kY16;
    case V4l2Format::kInzi:
      return DepthFormat::kInzi;
  }
  return DepthFormat::kZ16;
}

/// A camera that is away is added all the same: its status says so until it comes.
Result<void> add_v4l2(const V4l2Settings& chosen, Devices& devices) {
  V4l2Camera::Settings settings;
  settings.geometry.id = chosen.placement.name;
  settings.geometry.intrinsics = chosen.placement.intrinsics.value_or(CameraIntrinsics{});
  settings.geometry.station_from_camera = chosen.placement.station_from_camera;
  settings.depth_unit_mm = chosen.depth_unit_mm;
  settings.format = format_of(chosen.format);
  settings.address = {chosen.bus_path, chosen.serial};
  for (const auto& [name, value] : chosen.controls) settings.controls.push_back({name, value});
  devices.usb[chosen.placement.name] = settings.address;
  auto camera = V4l2Camera::create(std::move(settings));
  if (!camera) return tl::make_unexpected(camera.error());
  devices.cameras.push_back(std::move(*camera));
  return {};
}

/// Frames are told apart by their camera's name.
Result<void> check_names(const Devices& devices) {
  std::set<std::string> names;
  for (const auto& camera : devices.cameras) {
    const auto& name = camera->description().geometry.id;
    if (names.insert(name).second) continue;
    return fail(ErrorCode::kInvalidInput, "two cameras are called " + name,
                "name each source once among the [[camera]] tables");
  }
  return {};
}

Result<void> add_source(const CameraSettings& source, const Settings& settings, OpenSensors& kept,
                        Devices& devices) {
  switch (source.kind) {
    case CameraKind::kSimulated:
      return add_simulated(settings.simulation, devices);
    case CameraKind::kRecording:
      return add_recording(source.path, devices);
    case CameraKind::kOpenni:
      return add_openni(source.openni, kept, devices);
    case CameraKind::kV4l2:
      return add_v4l2(source.v4l2, devices);
  }
  return {};
}

/// Leaves in `kept` the sensors that it could open, if it fails, for the next time.
OpenedDevices open_all(OpenSensors& kept, const Settings& settings) {
  Devices devices;
  OpeningFailure failure;
  for (const auto& source : settings.cameras) {
    const auto* placed = source.placement();
    if (placed != nullptr) devices.calibration = source_of_poses(settings);
    const auto added = add_source(source, settings, kept, devices);
    // One that is away does not hide what is wrong with another.
    if (!added) failure.sources.push_back({placed != nullptr ? placed->name : "", added.error()});
  }
  if (!failure.sources.empty()) {
    for (const auto& camera : devices.cameras) {
      failure.without_fault.push_back(camera->description().geometry.id);
    }
    kept.keep(settings, std::move(devices));
    return tl::make_unexpected(std::move(failure));
  }
  kept.clear();
  if (const auto distinct = check_names(devices); !distinct) {
    return tl::make_unexpected(OpeningFailure{{{"", distinct.error()}}, {}});
  }
  return devices;
}

GpioBias bias_of(PedalBias bias) {
  switch (bias) {
    case PedalBias::kPullUp:
      return GpioBias::kPullUp;
    case PedalBias::kPullDown:
      return GpioBias::kPullDown;
    case PedalBias::kNone:
      return GpioBias::kNone;
  }
  return GpioBias::kPullUp;
}

using OpenedPedal = Result<std::unique_ptr<Pedal>>;

template <typename Kind>
OpenedPedal as_pedal(Result<std::unique_ptr<Kind>> opened) {
  if (!opened) return tl::make_unexpected(opened.error());
  return std::move(*opened);
}

GpioLineAddress address_of(const GpioPlace& place) {
  GpioLineAddress address{place.line, place.chip, std::nullopt};
  if (place.offset) address.offset = static_cast<unsigned>(*place.offset);
  return address;
}

OpenedPedal open_gpio_pedal(const GpioPedalSettings& chosen) {
  GpioPedal::Settings settings;
  settings.address = address_of(chosen.place);
  settings.active_low = chosen.active_low;
  settings.bias = bias_of(chosen.bias);
  return as_pedal(GpioPedal::open(settings));
}

Result<FaultScript> fault_script_of(const Settings& settings) {
  return read_fault_script(settings.simulation.fault_script).and_then(parse_fault_script);
}

OpenedPedal open_simulated_pedal(const Settings& settings) {
  const auto script = fault_script_of(settings);
  if (!script) return tl::make_unexpected(script.error());
  return as_pedal(SimulatedPedal::open({.faults = script->pedal, .fifo = settings.pedal.fifo}));
}

}  // namespace

std::optional<UsbAddress> usb_address_of(const OpenniSettings& sensor,
                                         const DeviceFolders& folders) {
  if (sensor.serial.empty()) return std::nullopt;
  const auto plugged = list_usb_devices(folders.sysfs, folders.dev);
  const auto is_it = [&](const auto& one) { return one.device.address.serial == sensor.serial; };
  const auto found = std::find_if(plugged.begin(), plugged.end(), is_it);
  if (found == plugged.end() || !is_openni_sensor(found->vendor)) return std::nullopt;
  // What has the same number may be a disk, and would be reset in the sensor's stead.
  if (std::count_if(plugged.begin(), plugged.end(), is_it) > 1) return std::nullopt;
  return UsbAddress{.bus_path = {}, .serial = sensor.serial};
}

Result<Devices> open_devices(const Settings& settings) {
  return open_devices_at_last()(settings).map_error(
      [](const OpeningFailure& failure) { return failure.as_one(); });
}

OpenDevices open_devices_at_last() {
  return [kept = std::make_shared<OpenSensors>()](const Settings& settings) {
    return open_all(*kept, settings);
  };
}

Result<void> check_fault_script(const Settings& settings) {
  if (!settings.has_simulated_parts()) return {};
  return fault_script_of(settings).map([](const FaultScript&) {});
}

std::optional<double> platform_height_mm(const Settings& settings, const Devices& devices) {
  const auto& set_mm = settings.station.platform_height_mm;
  return set_mm ? set_mm : devices.platform_height_mm;
}

Result<std::unique_ptr<Pedal>> open_pedal(const Settings& settings) {
  switch (settings.pedal.kind) {
    case PedalKind::kNone:
      return nullptr;
    case PedalKind::kSimulated:
      return open_simulated_pedal(settings);
    case PedalKind::kGpio:
      return open_gpio_pedal(settings.pedal.gpio);
    case PedalKind::kEvdev:
      return as_pedal(EvdevPedal::open(
          {.device = settings.pedal.evdev.device, .key = settings.pedal.evdev.key}));
  }
  return nullptr;
}

Result<std::unique_ptr<OutputLine>> open_output(const GpioOutputSettings& chosen) {
  auto opened =
      GpioOutput::open({.address = address_of(chosen.place), .active_low = chosen.active_low});
  if (!opened) return tl::make_unexpected(opened.error());
  return std::move(*opened);
}

Result<void> check_output(const GpioOutputSettings& chosen) {
  const auto line = GpioLine::find(address_of(chosen.place));
  if (!line) return tl::make_unexpected(line.error());
  return line->check_free();
}

}  // namespace instep
