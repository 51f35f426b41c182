#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.h"
#include "drivers/files/descriptor.h"

struct libevdev;

namespace instep {

/// USB ids as they are written: four hexadecimal digits each, as in "0c45:7403".
struct UsbIds {
  int vendor = 0;
  int product = 0;
  /// Nothing if `text` is not written so.
  static std::optional<UsbIds> parse(std::string_view text);
};

/// An input device of the kernel, open for reading, by libevdev.
class InputDevice {
 public:
  /// Fails with kNotFound, kPermissionDenied, kUnsupported if it is no input device, or kIo if the
  /// system has no descriptor or memory for it.
  static Result<std::unique_ptr<InputDevice>> open(const std::filesystem::path& node);
  /// The one device in `folder` (/dev/input) that `device` means, its USB ids or its name in by-id,
  /// and that has this key. Fails as open() does, or with kInvalidInput if there are several.
  static Result<std::unique_ptr<InputDevice>> find(const std::filesystem::path& folder,
                                                   const std::string& device, unsigned key);

  libevdev* get() const { return events_.get(); }
  int descriptor() const { return node_.number(); }
  bool has_key(unsigned key) const;

 private:
  struct Free {
    void operator()(libevdev* events) const;
  };

  explicit InputDevice(int descriptor) : node_(descriptor) {}

  Descriptor node_;
  std::unique_ptr<libevdev, Free> events_;
};

}  // namespace instep
