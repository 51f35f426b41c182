#include "drivers/evdev/input_device.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <libevdev/libevdev.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include "drivers/files/folder_entries.h"
#include "drivers/files/node_error.h"
#include "drivers/files/system_user.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

std::string advice_on_rights() {
  return "let the udev rules of Instep name it, then: " + command_to_join("plugdev");
}

Error not_opened(int error_number, const fs::path& node) {
  if (auto known = node_error(error_number, node, advice_on_rights(), "plug the pedal in")) {
    return *known;
  }
  return fail(ErrorCode::kIo,
              fmt::format("{} cannot be opened: {}", node.string(), std::strerror(error_number)),
              "check the limits on open files and memory")
      .value();
}

/// None where there is no such folder, as on a machine without any input device.
Result<std::vector<fs::path>> nodes_in(const fs::path& folder) {
  FolderEntries nodes = entries_of(folder, "event");
  if (nodes.failure && nodes.failure != std::errc::no_such_file_or_directory) {
    return tl::make_unexpected(not_opened(nodes.failure.value(), folder));
  }
  return std::move(nodes.paths);
}

std::optional<int> hexadecimal(std::string_view text) {
  unsigned value = 0;
  const auto [end, wrong] = std::from_chars(text.begin(), text.end(), value, 16);
  if (text.size() != 4 || wrong != std::errc() || end != text.end()) return std::nullopt;
  return static_cast<int>(value);
}

bool is(const InputDevice& device, const UsbIds& ids) {
  return libevdev_get_id_vendor(device.get()) == ids.vendor &&
         libevdev_get_id_product(device.get()) == ids.product;
}

std::string key_name(unsigned key) {
  const char* name = libevdev_event_code_get_name(EV_KEY, key);
  return name == nullptr ? std::to_string(key) : name;
}

Result<std::unique_ptr<InputDevice>> find_by_name(const fs::path& folder, const std::string& name,
                                                  unsigned key) {
  auto device = InputDevice::open(folder / "by-id" / name);
  if (device && !(*device)->has_key(key)) {
    return fail(ErrorCode::kNotFound, fmt::format("{} has no key {}", name, key_name(key)),
                "press the pedal while evtest shows its keys");
  }
  return device;
}

Result<std::unique_ptr<InputDevice>> find_by_ids(const fs::path& folder, const UsbIds& ids,
                                                 const std::string& text, unsigned key) {
  const auto nodes = nodes_in(folder);
  if (!nodes) return tl::make_unexpected(nodes.error());
  std::unique_ptr<InputDevice> found;
  std::string closed;  // the last device that this user may not open
  bool without_key = false;
  for (const auto& node : *nodes) {
    auto device = InputDevice::open(node);
    if (!device) {
      if (device.error().code == ErrorCode::kIo) return device;
      if (device.error().code == ErrorCode::kPermissionDenied) closed = node.string();
      continue;
    }
    if (!is(**device, ids)) continue;
    if (!(*device)->has_key(key)) {
      without_key = true;
      continue;
    }
    if (found) {
      return fail(ErrorCode::kInvalidInput,
                  fmt::format("two devices {} have the key {}", text, key_name(key)),
                  "choose one by its name in /dev/input/by-id");
    }
    found = std::move(*device);
  }
  if (found) return found;
  if (!closed.empty() && !without_key) {
    return fail(
        ErrorCode::kPermissionDenied,
        fmt::format("no {} among the devices that this user may open; {} is none", text, closed),
        advice_on_rights());
  }
  return fail(ErrorCode::kNotFound,
              without_key ? fmt::format("the device {} has no key {}", text, key_name(key))
                          : "no input device " + text + " is plugged in",
              without_key ? "press the pedal while evtest shows its keys" : "plug the pedal in");
}

}  // namespace

std::optional<UsbIds> UsbIds::parse(std::string_view text) {
  if (text.size() != 9 || text[4] != ':') return std::nullopt;
  const auto vendor = hexadecimal(text.substr(0, 4));
  const auto product = hexadecimal(text.substr(5));
  if (!vendor || !product) return std::nullopt;
  return UsbIds{*vendor, *product};
}

void InputDevice::Free::operator()(libevdev* events) const {
  libevdev_free(events);
}

bool InputDevice::has_key(unsigned key) const {
  return libevdev_has_event_code(get(), EV_KEY, key) == 1;
}

Result<std::unique_ptr<InputDevice>> InputDevice::open(const fs::path& node) {
  std::unique_ptr<InputDevice> device(
      new InputDevice(::open(node.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)));
  if (device->descriptor() < 0) return tl::make_unexpected(not_opened(errno, node));
  libevdev* events = nullptr;
  if (const int failed = libevdev_new_from_fd(device->descriptor(), &events); failed < 0) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{} is no input device: {}", node.string(), std::strerror(-failed)),
                "choose the pedal by its USB ids or by its name in /dev/input/by-id");
  }
  device->events_.reset(events);
  return device;
}

Result<std::unique_ptr<InputDevice>> InputDevice::find(const fs::path& folder,
                                                       const std::string& device, unsigned key) {
  if (const auto ids = UsbIds::parse(device)) return find_by_ids(folder, *ids, device, key);
  return find_by_name(folder, device, key);
}

}  // namespace instep
