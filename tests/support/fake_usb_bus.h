#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace instep::test {

/// The folders in which the kernel shows USB cameras, /sys and /dev, as a tree of its own.
class FakeUsbBus {
 public:
  struct Camera {
    std::string port{};  ///< as in sysfs: "2", or "2.3" behind a hub
    std::string serial{};
    std::vector<int> nodes{};  ///< the N of its /dev/videoN
    int speed_mbps = 480;
    std::string usb_version = " 2.00";
  };

  std::filesystem::path sysfs() const { return folder_.path() / "sys"; }
  std::filesystem::path dev() const { return folder_.path() / "dev"; }
  /// /sys/bus/usb/devices/1-<port>
  std::filesystem::path usb_folder(const std::string& port) const;

  void plug(const Camera& camera);
  void unplug(const Camera& camera);

 private:
  TemporaryFolder folder_;
};

}  // namespace instep::test
