#include "drivers/usb/usb_device.h"

#include <gtest/gtest.h>

#include "tests/support/fake_usb_bus.h"

namespace instep {
namespace {

UsbDevice device_with(int speed_mbps, const std::string& usb_version) {
  test::FakeUsbBus bus;
  bus.plug({.port = "1.4",
            .serial = "A1",
            .nodes = {},
            .speed_mbps = speed_mbps,
            .usb_version = usb_version});
  return read_usb_device(bus.usb_folder("1.4")).value();
}

TEST(UsbDevice, IsDescribedByTheKernelsFiles) {
  const auto device = device_with(480, " 2.00");
  EXPECT_EQ(device.address.bus_path, "usb-0000:00:14.0-1.4");
  EXPECT_EQ(device.address.serial, "A1");
  EXPECT_EQ(device.product, "Depth Camera");
  EXPECT_EQ(device.link_mbps, 480);
}

// A USB 3 camera on a USB 2 link reports version 2.10 and 480 Mbit/s.
TEST(UsbDevice, TellsAUsb3DeviceOnAUsb2Link) {
  EXPECT_TRUE(device_with(480, " 2.10").could_be_faster);
  EXPECT_FALSE(device_with(480, " 2.00").could_be_faster) << "a USB 2 device";
  EXPECT_FALSE(device_with(5000, " 3.20").could_be_faster);
  EXPECT_FALSE(device_with(10000, " 3.20").could_be_faster);
}

TEST(UsbDevice, IsNothingWhereNoDeviceIs) {
  test::FakeUsbBus bus;
  EXPECT_FALSE(read_usb_device(bus.sysfs() / "nowhere"));
  EXPECT_FALSE(read_usb_device("/"));
}

}  // namespace
}  // namespace instep
