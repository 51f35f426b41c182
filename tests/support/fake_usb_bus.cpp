#include "tests/support/fake_usb_bus.h"

#include <fstream>

namespace instep::test {
namespace {

namespace fs = std::filesystem;

void write_line(const fs::path& file, const std::string& line) {
  std::ofstream(file) << line << "\n";
}

}  // namespace

fs::path FakeUsbBus::usb_folder(const std::string& port) const {
  return sysfs() / "devices/pci0000:00/0000:00:14.0/usb1" / ("1-" + port);
}

void FakeUsbBus::plug(const Camera& camera) {
  const fs::path device = usb_folder(camera.port);
  const fs::path interface = device / ("1-" + camera.port + ":1.0");
  fs::create_directories(interface);
  fs::create_directories(sysfs() / "class/video4linux");
  fs::create_directories(sysfs() / "bus/usb/devices");
  fs::create_directory_symlink(device, sysfs() / "bus/usb/devices" / ("1-" + camera.port));
  write_line(device / "devpath", camera.port);
  write_line(device / "product", "Depth Camera");
  write_line(device / "speed", std::to_string(camera.speed_mbps));
  write_line(device / "version", camera.usb_version);
  if (!camera.serial.empty()) write_line(device / "serial", camera.serial);
  for (const int number : camera.nodes) {
    const std::string name = "video" + std::to_string(number);
    const fs::path node = interface / "video4linux" / name;
    fs::create_directories(node);
    write_line(node / "name", "Depth Camera: Depth");
    fs::create_directory_symlink(interface, node / "device");
    fs::create_directory_symlink(node, sysfs() / "class/video4linux" / name);
  }
}

void FakeUsbBus::unplug(const Camera& camera) {
  for (const int number : camera.nodes) {
    fs::remove(sysfs() / "class/video4linux" / ("video" + std::to_string(number)));
  }
  fs::remove(sysfs() / "bus/usb/devices" / ("1-" + camera.port));
  fs::remove_all(usb_folder(camera.port));
}

}  // namespace instep::test
