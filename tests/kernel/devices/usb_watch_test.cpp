#include <gtest/gtest.h>
#include <poll.h>

#include <chrono>

#include "drivers/usb/libusb_watch.h"
#include "tests/kernel/devices/usb_depth_camera.h"

namespace instep::test {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

UsbDepthCamera::Scene dark() {
  return [](std::uint32_t) { return std::vector<std::uint16_t>(160U * 120U); };
}

class UsbWatchTest : public testing::Test {
 protected:
  UsbWatchTest() : watch_(open_libusb_watch().value()) {}

  /// The next change of the camera with this serial; nothing if none came in time.
  std::optional<UsbChange> next(const std::string& serial) {
    const auto deadline = steady_clock::now() + 10s;
    while (steady_clock::now() < deadline) {
      for (const auto& change : watch_->changes()) {
        if (change.device.address.serial == serial) return change;
      }
      // Nothing but its descriptor says when there is something.
      pollfd readable{watch_->descriptor(), POLLIN, 0};
      const auto left =
          std::chrono::ceil<std::chrono::milliseconds>(deadline - steady_clock::now());
      if (::poll(&readable, 1, static_cast<int>(left.count())) <= 0) break;
    }
    return std::nullopt;
  }

  std::unique_ptr<UsbWatch> watch_;
};

TEST_F(UsbWatchTest, TellsThatACameraCameAndLeft) {
  UsbDepthCamera usb({.port = 2, .serial = "A1"}, dark());
  for (int round = 0; round < 3; ++round) {
    usb.plug();
    const auto came = next("A1");
    ASSERT_TRUE(came && came->arrived);
    EXPECT_EQ(came->device.address.bus_path, usb.bus_path());
    EXPECT_EQ(came->device.product, "Depth Camera");
    EXPECT_EQ(came->device.link_mbps, 480);
    EXPECT_FALSE(came->device.could_be_faster);
    usb.unplug();
    const auto left = next("A1");
    ASSERT_TRUE(left && !left->arrived);
    EXPECT_EQ(left->device.address.bus_path, usb.bus_path());
  }
}

TEST_F(UsbWatchTest, TellsWhatWasPluggedInBefore) {
  UsbDepthCamera usb({.port = 1, .serial = "B2"}, dark());
  usb.plug();
  ASSERT_TRUE(next("B2"));
  watch_ = open_libusb_watch().value();
  const auto there = next("B2");
  EXPECT_TRUE(there && there->arrived);
}

// Such a link works, and fails after hours.
TEST_F(UsbWatchTest, SeesThatAUsb3CameraIsLinkedAsUsb2) {
  UsbDepthCamera usb({.port = 1, .serial = "C3", .usb_version = 0x0210}, dark());
  usb.plug();
  const auto came = next("C3");
  ASSERT_TRUE(came);
  EXPECT_TRUE(came->device.could_be_faster);
}

// A reset ends the handle that it was asked through: the device leaves and comes back.
TEST_F(UsbWatchTest, ResetsADeviceThatIsThere) {
  UsbDepthCamera usb({.port = 1, .serial = "D4"}, dark());
  usb.plug();
  ASSERT_TRUE(next("D4"));
  const auto reset = reset_usb_device({usb.bus_path(), "D4"});
  EXPECT_TRUE(reset) << reset.error().line();
  const auto absent = reset_usb_device({"", "nobody's"});
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ErrorCode::kDeviceGone);
}

// What shares the number of a camera may be a disk.
TEST_F(UsbWatchTest, ResetsNothingWhereTwoDevicesHaveTheNumber) {
  UsbDepthCamera one({.port = 1, .serial = "E5"}, dark());
  UsbDepthCamera other({.port = 2, .serial = "E5"}, dark());
  one.plug();
  ASSERT_TRUE(next("E5"));
  other.plug();
  ASSERT_TRUE(next("E5"));
  const auto unclear = reset_usb_device({"", "E5"});
  ASSERT_FALSE(unclear);
  EXPECT_EQ(unclear.error().code, ErrorCode::kInvalidInput);
  const auto clear = reset_usb_device({other.bus_path(), "E5"});
  EXPECT_TRUE(clear) << clear.error().line();
}

}  // namespace
}  // namespace instep::test
