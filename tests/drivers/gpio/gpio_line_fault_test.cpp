#include "drivers/gpio/gpio_line.h"

#include <gpiod.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "drivers/files/system_user.h"
#include "drivers/gpio/gpio_chips.h"
#include "tests/support/temporary_folder.h"

namespace {

/// Why no chip can be opened.
int failure = ENODEV;

}  // namespace

/// Stands before that of the library: here is no chip that would fail so.
extern "C" gpiod_chip* gpiod_chip_open(const char*) {
  errno = failure;
  return nullptr;
}

namespace instep {
namespace {

// A line that is plugged in was said to be missing.
TEST(GpioLineSearch, SaysWhyAChipCannotBeOpened) {
  const test::TemporaryFolder devices;
  std::ofstream(devices.path() / "gpiochip0");
  const auto code_at = [&](int reason) {
    failure = reason;
    return GpioLine::find({"pedal", "", {}}, devices.path()).error().code;
  };
  for (const int of_system : {EMFILE, ENFILE, ENOMEM, EIO}) {
    EXPECT_EQ(code_at(of_system), ErrorCode::kIo) << of_system;
  }
  EXPECT_EQ(code_at(EACCES), ErrorCode::kPermissionDenied);
  EXPECT_EQ(GpioLine::find({"pedal", "", {}}, devices.path()).error().advice,
            command_to_join("plugdev") + ", where the udev rules of Instep are installed");
  for (const int of_none : {ENOENT, ENODEV, ENOTTY}) {
    EXPECT_EQ(code_at(of_none), ErrorCode::kNotFound) << of_none;
  }
}

// The list had none of them, as if there were no board.
TEST(GpioChips, AreListedWithWhatKeepsTheSystemFromOpeningThem) {
  const test::TemporaryFolder devices;
  std::ofstream(devices.path() / "gpiochip0");
  for (const int of_system : {EMFILE, ENFILE, ENOMEM, EIO}) {
    failure = of_system;
    const auto chips = list_gpio_chips(devices.path());
    ASSERT_EQ(chips.size(), 1U) << of_system;
    EXPECT_EQ(chips[0].trouble, std::strerror(of_system));
    EXPECT_TRUE(chips[0].may_open);
  }
  failure = EACCES;
  const auto closed = list_gpio_chips(devices.path());
  ASSERT_EQ(closed.size(), 1U);
  EXPECT_FALSE(closed[0].may_open);
  for (const int of_none : {ENOENT, ENODEV, ENOTTY}) {
    failure = of_none;
    EXPECT_TRUE(list_gpio_chips(devices.path()).empty()) << of_none;
  }
}

}  // namespace
}  // namespace instep
