#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "core/result.h"
#include "daemon/station/opening_failure.h"
#include "drivers/depth_camera.h"
#include "drivers/output_line.h"
#include "drivers/pedal.h"
#include "drivers/usb/usb_device.h"
#include "drivers/v4l2/video_nodes.h"

namespace instep {

/// What the settings say is plugged in, opened.
struct Devices {
  std::vector<std::unique_ptr<DepthCamera>> cameras;
  std::optional<double> platform_height_mm;  ///< as the cameras' source says it, if it does
  std::string calibration;                   ///< where the cameras' poses come from
  bool simulated = false;
  std::map<std::string, UsbAddress> usb;  ///< of the cameras on the USB bus, by their name
  /// Gives what Capture::truth holds; empty if nothing is known. May take seconds, so call it where
  /// nobody waits. Needs nothing of these devices, which may be gone by then.
  std::function<Result<std::map<std::string, double>>()> work_out_truth;
};

/// The one place that knows the camera families: a new one is a new case here. May take some
/// seconds (a simulated station builds its foot). Fails with what the family says, of each
/// source that cannot be opened, and closes the others again; worth another try later, since a
/// camera that is away at boot may come.
Result<Devices> open_devices(const Settings& settings);

/// The same for whoever tries again until all are there: OpenNI2 sensors that it could open stay
/// open from a call that failed to the next. For one thread at a time.
using OpenedDevices = tl::expected<Devices, OpeningFailure>;
using OpenDevices = std::function<OpenedDevices(const Settings&)>;
OpenDevices open_devices_at_last();

/// z of the standing surface, by the settings or else as the cameras' source says it. Asked anew
/// for each scan: the settings may take theirs back while the devices stay open.
std::optional<double> platform_height_mm(const Settings& settings, const Devices& devices);

/// Where a sensor is on USB, to be watched and reset there; nothing if the bus does not show it by
/// that serial number (its descriptor may have none, or another than it tells OpenNI2), or shows
/// something else by it as well.
std::optional<UsbAddress> usb_address_of(const OpenniSettings& sensor,
                                         const DeviceFolders& folders);

/// Whether the faults on command, if something simulated is to have some, can be read.
Result<void> check_fault_script(const Settings& settings);

/// The pedal, or nullptr if the settings say that there is none.
Result<std::unique_ptr<Pedal>> open_pedal(const Settings& settings);

using OpenPedal = std::function<Result<std::unique_ptr<Pedal>>(const Settings&)>;

/// A lamp or a projector, which is off then.
Result<std::unique_ptr<OutputLine>> open_output(const GpioOutputSettings& chosen);
/// Whether it could be opened now, without touching its line.
Result<void> check_output(const GpioOutputSettings& chosen);

}  // namespace instep
