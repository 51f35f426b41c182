#include "drivers/usb/libusb_watch.h"

#include <libusb-1.0/libusb.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "drivers/files/poll_set.h"

namespace instep {
namespace {

struct ContextCloser {
  void operator()(libusb_context* context) const { libusb_exit(context); }
};
using Context = std::unique_ptr<libusb_context, ContextCloser>;

Result<Context> open_context() {
  libusb_context* context = nullptr;
  const int failed = libusb_init(&context);
  if (failed == 0) return Context(context);
  return fail(ErrorCode::kNotFound,
              std::string("USB cannot be watched: ") + libusb_strerror(failed),
              "check that /dev/bus/usb is there");
}

/// The folder of a device in sysfs is called by its bus and the ports on the way to it: 1-2.3.
std::string sysfs_name(libusb_device* device) {
  constexpr int kDeepest = 7;  // of the USB standard
  std::array<std::uint8_t, kDeepest> ports{};
  const int depth = libusb_get_port_numbers(device, ports.data(), kDeepest);
  if (depth <= 0) return {};  // the controller's own hub
  std::string name = std::to_string(libusb_get_bus_number(device));
  for (int i = 0; i < depth; ++i) {
    name += i == 0 ? '-' : '.';
    name += std::to_string(ports[static_cast<std::size_t>(i)]);
  }
  return name;
}

std::optional<UsbDevice> describe(const std::string& name) {
  return read_usb_device(std::filesystem::path("/sys/bus/usb/devices") / name);
}

class LibusbWatch final : public UsbWatch {
 public:
  LibusbWatch(Context context, PollSet waiting)
      : context_(std::move(context)), waiting_(std::move(waiting)) {}

  Result<void> begin() {
    if (const auto waiting = wait_for_all(); !waiting) return waiting;
    constexpr int kBoth = LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT;
    const int failed = libusb_hotplug_register_callback(
        context_.get(), kBoth, LIBUSB_HOTPLUG_ENUMERATE, LIBUSB_HOTPLUG_MATCH_ANY,
        LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY, on_event, this, nullptr);
    if (failed == 0) return {};
    return fail(ErrorCode::kUnsupported,
                std::string("USB cannot be watched: ") + libusb_strerror(failed), "start udevd");
  }

  int descriptor() const override { return waiting_.descriptor(); }

  std::vector<UsbChange> changes() override {
    timeval at_once{0, 0};
    libusb_handle_events_timeout_completed(context_.get(), &at_once, nullptr);
    std::vector<UsbChange> changes;
    for (const auto& [name, arrived] : std::exchange(events_, {})) {
      if (const auto device = arrived ? describe(name) : std::nullopt) known_[name] = *device;
      const auto known = known_.find(name);
      if (known == known_.end()) continue;  // left before it could be looked at
      changes.push_back({known->second, arrived});
      if (!arrived) known_.erase(known);
    }
    return changes;
  }

 private:
  Result<void> wait_for_all() {
    const libusb_pollfd** waits = libusb_get_pollfds(context_.get());
    if (waits == nullptr) {
      return fail(ErrorCode::kIo, "USB cannot be watched: libusb does not say what it waits for",
                  "free some memory");
    }
    int failed = 0;
    for (const libusb_pollfd** one = waits; *one != nullptr && failed == 0; ++one) {
      const auto events = static_cast<std::uint32_t>((*one)->events);
      if (!waiting_.add((*one)->fd, events)) failed = errno;
    }
    libusb_free_pollfds(waits);
    if (failed == 0) return {};
    return fail(ErrorCode::kIo, std::string("USB cannot be watched: ") + std::strerror(failed),
                "check the limits on open files and memory");
  }

  /// Only notes the event: libusb must not be called back from here but for what it has at hand.
  static int on_event(libusb_context*, libusb_device* device, libusb_hotplug_event event,
                      void* user) {
    std::string name = sysfs_name(device);
    if (!name.empty()) {
      static_cast<LibusbWatch*>(user)->events_.emplace_back(
          std::move(name), event == LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED);
    }
    return 0;
  }

  Context context_;
  PollSet waiting_;  ///< all that libusb waits for
  std::vector<std::pair<std::string, bool>> events_;
  std::map<std::string, UsbDevice> known_;
};

Error reset_error(int number, const UsbDevice& device) {
  const std::string message = "resetting " + device.text() + " failed: " + libusb_strerror(number);
  if (number == LIBUSB_ERROR_ACCESS) {
    return {ErrorCode::kPermissionDenied, Remedy::kOperator, message,
            "let the user of the daemon write its node in /dev/bus/usb, by a udev rule"};
  }
  return {ErrorCode::kIo, Remedy::kOperator, message, "unplug it and plug it in again"};
}

Result<void> reset(libusb_device* device, const UsbDevice& description) {
  libusb_device_handle* handle = nullptr;
  int failed = libusb_open(device, &handle);
  if (failed == 0) {
    failed = libusb_reset_device(handle);
    libusb_close(handle);
  }
  // Not found: the reset went through, and the device came back as another.
  if (failed == 0 || (handle != nullptr && failed == LIBUSB_ERROR_NOT_FOUND)) return {};
  return tl::make_unexpected(reset_error(failed, description));
}

}  // namespace

Result<std::unique_ptr<UsbWatch>> open_libusb_watch() {
  auto context = open_context();
  if (!context) return tl::make_unexpected(context.error());
  PollSet waiting;
  if (!waiting.is_open()) {
    return fail(ErrorCode::kIo, std::string("USB cannot be watched: ") + std::strerror(errno),
                "check the limit on open files");
  }
  auto watch = std::make_unique<LibusbWatch>(std::move(*context), std::move(waiting));
  if (const auto begun = watch->begin(); !begun) return tl::make_unexpected(begun.error());
  return watch;
}

Result<void> reset_usb_device(const UsbAddress& address) {
  const auto context = open_context();
  if (!context) return tl::make_unexpected(context.error());
  libusb_device** list = nullptr;
  const auto count = libusb_get_device_list(context->get(), &list);
  Result<void> outcome =
      fail(ErrorCode::kDeviceGone, "the device to reset is not there", "plug it in");
  std::optional<UsbDevice> found;
  libusb_device* place = nullptr;
  for (ssize_t i = 0; i < count; ++i) {
    const std::string name = sysfs_name(list[i]);
    const auto device = name.empty() ? std::nullopt : describe(name);
    if (!device || !device->is_meant_by(address)) continue;
    if (found) {
      // The other may be anything: a disk, the keyboard.
      found.reset();
      outcome = fail(ErrorCode::kInvalidInput, Remedy::kOperator,
                     "several USB devices have the serial " + address.serial + ": none is reset",
                     "set bus_path too, as instep devices shows it, or unplug the others");
      break;
    }
    found = device;
    place = list[i];
  }
  if (found) outcome = reset(place, *found);
  if (count >= 0) libusb_free_device_list(list, 1);
  return outcome;
}

}  // namespace instep
