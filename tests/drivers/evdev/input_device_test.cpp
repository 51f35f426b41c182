#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>

#include "drivers/evdev/evdev_pedal.h"
#include "drivers/evdev/input_device.h"
#include "drivers/gpio/gpio_pedal.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

TEST(UsbIds, AreFourHexadecimalDigitsEach) {
  const auto ids = UsbIds::parse("0c45:7aF3");
  ASSERT_TRUE(ids);
  EXPECT_EQ(ids->vendor, 0x0c45);
  EXPECT_EQ(ids->product, 0x7af3);
  for (const char* wrong : {"", ":", "0c45", "0c45:740", "0c45:74033", "0c45-7403", "-c45:7403",
                            "0c4g:7403", "0c45: 403", "usb-foot"}) {
    EXPECT_FALSE(UsbIds::parse(wrong)) << wrong;
  }
}

// What a machine without any such device says; what is there is for the tests against a kernel.
TEST(PedalsOfAMachineWithout, SayWhatIsMissing) {
  test::TemporaryFolder empty;
  const auto by_ids =
      EvdevPedal::open({.device = "0c45:7403", .key = "KEY_B", .devices = empty.path()});
  EXPECT_EQ(by_ids.error().code, ErrorCode::kNotFound);
  const auto by_name =
      EvdevPedal::open({.device = "usb-foot", .key = "KEY_B", .devices = empty.path()});
  EXPECT_EQ(by_name.error().code, ErrorCode::kNotFound);
  const auto wrong_key =
      EvdevPedal::open({.device = "0c45:7403", .key = "B", .devices = empty.path()});
  EXPECT_EQ(wrong_key.error().code, ErrorCode::kInvalidInput);

  GpioPedal::Settings settings;
  settings.devices = empty.path();
  EXPECT_EQ(GpioPedal::open(settings).error().code, ErrorCode::kInvalidInput) << "no address";
  settings.address.line = "foot";
  EXPECT_EQ(GpioPedal::open(settings).error().code, ErrorCode::kNotFound);
}

// A pedal that is plugged in cannot be helped by plugging it in.
TEST(PedalsOfAMachineWithout, DescriptorsSayThat) {
  test::TemporaryFolder devices;
  std::ofstream(devices.path() / "event0");
  // Once with descriptors: a sanitizer needs some to look at a kind of error that is new to it.
  const auto folder_away = InputDevice::find(devices.path() / "away", "0c45:7403", 1);
  EXPECT_EQ(folder_away.error().code, ErrorCode::kNotFound);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const rlimit none{0, limit.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &none);
  const auto opened = InputDevice::open(devices.path() / "event0");
  const auto found = InputDevice::find(devices.path(), "0c45:7403", 1);
  const auto line = GpioLine::find({"pedal", "", {}}, devices.path());
  ::setrlimit(RLIMIT_NOFILE, &limit);
  EXPECT_EQ(opened.error().code, ErrorCode::kIo);
  EXPECT_EQ(found.error().code, ErrorCode::kIo) << found.error().line();
  EXPECT_EQ(line.error().code, ErrorCode::kIo) << line.error().line();
  EXPECT_EQ(InputDevice::open(devices.path() / "event1").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace instep
