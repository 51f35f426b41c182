#pragma once

#include <memory>
#include <string>

#include "drivers/v4l2/v4l2_camera.h"
#include "tests/support/fake_usb_bus.h"
#include "tests/support/fake_video_kernel.h"

namespace instep::test {

/// A V4L2 camera of 64 x 48 pixels on a fake bus, with the fake kernel that serves it.
class V4l2Bench {
 public:
  static constexpr int kWidth = 64;
  static constexpr int kHeight = 48;

  V4l2Bench() { plug(0); }

  /// Plugs the camera in as /dev/video<number>.
  void plug(int number, FakeVideoDevice device = {}) {
    usb_.nodes = {number};
    bus_.plug(usb_);
    kernel_.add(node(), std::move(device));
  }
  void unplug() {
    bus_.unplug(usb_);
    kernel_.remove(node());
  }
  /// Another device in place of the one that is there.
  void replace(FakeVideoDevice device) {
    unplug();
    plug(0, std::move(device));
  }

  V4l2Camera::Settings settings() const {
    V4l2Camera::Settings settings;
    settings.geometry.id = "left";
    settings.geometry.intrinsics = {kWidth, kHeight, 60.0, 60.0, 31.5, 23.5, {}};
    settings.depth_unit_mm = 0.125;
    settings.address.serial = usb_.serial;
    settings.folders = {bus_.sysfs(), bus_.dev()};
    return settings;
  }
  std::unique_ptr<V4l2Camera> camera() { return camera(settings()); }
  std::unique_ptr<V4l2Camera> camera(const V4l2Camera::Settings& settings) {
    return V4l2Camera::create(settings, kernel_).value();
  }

  FakeUsbBus& bus() { return bus_; }
  FakeVideoKernel& kernel() { return kernel_; }
  std::string node() const {
    return (bus_.dev() / ("video" + std::to_string(usb_.nodes.front()))).string();
  }

 private:
  FakeUsbBus bus_;
  FakeUsbBus::Camera usb_{.port = "2", .serial = "A1", .nodes = {}};
  FakeVideoKernel kernel_;
};

}  // namespace instep::test
