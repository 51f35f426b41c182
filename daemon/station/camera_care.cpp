#include "daemon/station/camera_care.h"

#include <fmt/format.h>

#include <utility>

#include "drivers/usb/libusb_watch.h"

namespace instep {
namespace {

/// A device that arrives this soon after its reset was not plugged in by a person.
constexpr std::chrono::seconds kResetEcho{10};

std::string link_warning(const UsbDevice& device) {
  if (!device.could_be_faster) return {};
  return fmt::format(
      "it is linked at {} Mbit/s, as USB 2: if it is a USB 3 camera, use a USB 3 socket and cable",
      device.link_mbps);
}

}  // namespace

CameraCare::Bus CameraCare::real_bus() {
  return {open_libusb_watch, reset_usb_device};
}

CameraCare::CameraCare(EventLoop& loop, const std::vector<std::optional<UsbAddress>>& cameras,
                       Listener listener, Bus bus)
    : loop_(loop), listener_(std::move(listener)), bus_(std::move(bus)) {
  bool any_on_bus = false;
  for (const auto& address : cameras) {
    patients_.push_back({address, RecoveryLadder(address.has_value())});
    any_on_bus = any_on_bus || address;
  }
  if (!any_on_bus) return;
  monitor_.emplace(loop_, bus_.watch, [this](const UsbChange& change) { bus_changed(change); });
}

void CameraCare::put_off_watch() {
  if (monitor_) monitor_->put_off();
}

bool CameraCare::end_watch_by(std::chrono::steady_clock::time_point deadline) {
  return !monitor_ || monitor_->end_by(deadline);
}

void CameraCare::looked_at(std::size_t camera, const std::optional<Error>& trouble) {
  Patient& patient = patients_[camera];
  patient.in_trouble = trouble.has_value();
  if (!trouble) {
    patient.ladder.recovered();
  } else if (patient.ladder.failed(*trouble) == RecoveryLadder::Step::kReset) {
    reset(camera);
  }
  patient.health.recovery = patient.ladder.text();
}

void CameraCare::reset(std::size_t camera) {
  patients_[camera].last_reset = EventLoop::monotonic_now();
  reset_thread_.post([this, camera, address = *patients_[camera].address, reset = bus_.reset,
                      post = loop_.poster()](TaskProgress&) {
    const auto outcome = reset(address);
    if (outcome) return;  // whether it helped, the next look tells
    post([this, camera, line = outcome.error().line()] {
      patients_[camera].health.recovery = line;
      listener_.on_change();
    });
  });
}

void CameraCare::bus_changed(const UsbChange& change) {
  bool ours = false;
  bool look = false;
  for (Patient& patient : patients_) {
    if (!patient.address || !change.device.is_meant_by(*patient.address)) continue;
    ours = true;
    patient.health.link_mbps = change.arrived ? change.device.link_mbps : 0;
    patient.health.warning = change.arrived ? link_warning(change.device) : "";
    const auto now = EventLoop::monotonic_now();
    const bool by_hand = !patient.last_reset || *patient.last_reset + kResetEcho < now;
    if (change.arrived && by_hand) patient.ladder.recovered();
    look = look || change.arrived == patient.in_trouble;
  }
  if (look) listener_.look();
  if (ours) listener_.on_change();
}

}  // namespace instep
