#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace instep::test {

/// A USB depth camera in software, for the guest: it speaks the USB video class (UVC 1.0, one
/// format, one size, a bulk endpoint) over USB/IP to the kernel's own virtual controller, vhci_hcd.
/// Everything above the cable is real: enumeration, uvcvideo, udev, /dev/videoN.
///
/// It runs on a thread of its own. All calls may be made from any thread.
class UsbDepthCamera {
 public:
  /// The depth of frame `number`, width * height values.
  using Scene = std::function<std::vector<std::uint16_t>(std::uint32_t number)>;

  struct Settings {
    int port = 0;  ///< of the controller, 0 to 7; also its USB socket: usb-vhci_hcd.0-<port + 1>
    std::string serial = "0001";
    std::string four_letters = "Z16 ";  ///< or "Y16 "
    int width = 160;
    int height = 120;
    int frames_per_second = 15;
    std::uint16_t usb_version = 0x0200;  ///< 0x0210 is what USB 3 cameras say on a USB 2 link
    std::uint16_t vendor = 0x1209;       ///< whose sensor it is taken for: 0x1d27 is PrimeSense
  };

  /// Not plugged in yet.
  UsbDepthCamera(const Settings& settings, Scene scene);
  /// Unplugs it, and waits until the kernel has taken its nodes away.
  ~UsbDepthCamera();
  UsbDepthCamera(const UsbDepthCamera&) = delete;
  UsbDepthCamera& operator=(const UsbDepthCamera&) = delete;

  void plug();
  /// Ends the connection at once, in the middle of whatever goes on.
  void unplug();

  // Faults of the frames to come.
  void flag_frames(int count);     ///< the error bit of their payload headers is set
  void shorten_frames(int count);  ///< half of their data is missing
  void fall_silent(bool silent);   ///< answers, but sends no frame
  void stall_probes(int count);    ///< refuses as many requests of the stream's negotiation

  std::uint32_t frames_sent() const;
  /// How often the host has set it up: once for each plug(), and for each reset.
  int set_ups() const;

  /// The bus path of its socket, as UsbAddress has it.
  std::string bus_path() const;

 private:
  class Device;
  std::shared_ptr<Device> device_;
};

}  // namespace instep::test
