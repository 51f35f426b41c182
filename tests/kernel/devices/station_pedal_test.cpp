#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "drivers/gpio/gpio_pedal.h"
#include "tests/kernel/devices/foot_switch.h"
#include "tests/kernel/devices/gpio_chip.h"
#include "tests/support/station_process.h"

namespace instep::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr auto kLong = 40s;
constexpr auto kAMoment = 100ms;  // three times the debounce time

/// The smallest station that gives a result, since an emulated processor is slow.
std::string settings(const std::string& pedal) {
  return StationProcess::tiny_settings() + "[pedal]\n" + pedal;
}
const std::string kGpio = "kind = \"gpio\"\n[pedal.gpio]\nline = \"foot\"\n";
const std::string kEvdev =
    "kind = \"evdev\"\n[pedal.evdev]\ndevice = \"0c45:7403\"\nkey = \"KEY_B\"\n";

int results_in(const std::filesystem::path& store) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(store)) {
    count += entry.path().filename() == "result.json" ? 1 : 0;
  }
  return count;
}

/// The real daemon with a real line of the kernel.
class StationWithPedal : public testing::Test {
 protected:
  void start(const std::string& pedal) {
    station_.write_settings(settings(pedal));
    station_.start();
  }

  StationProcess station_;
};

// One press, many events.
TEST_F(StationWithPedal, ScansOnceWhenTheLineBouncesTwoThousandTimes) {
  GpioChip chip("pedal", "board", 3, "foot");
  start(kGpio);
  ASSERT_TRUE(station_.wait_for("STATUS=ready", kLong)) << station_.log();
  for (int i = 0; i < 1000; ++i) {
    chip.close_contact();
    chip.open_contact();
  }
  chip.close_contact();
  ASSERT_TRUE(station_.wait_for("STATUS=capturing", kLong)) << station_.log();
  chip.open_contact();
  ASSERT_TRUE(station_.wait_for("STATUS=ready", kLong)) << station_.log();
  std::this_thread::sleep_for(kAMoment);
  EXPECT_FALSE(station_.wait_for("STATUS=capturing", 0s));
  EXPECT_EQ(results_in(station_.store()), 1) << station_.log();
}

// Something stands on it while the station starts.
TEST_F(StationWithPedal, DoesNotScanForAPedalThatWasHeldAtStartUp) {
  GpioChip chip("pedal", "board", 3, "foot");
  // The bias that the daemon asks for would undo a contact closed now.
  const auto bias = kGpio + "bias = \"none\"\n";
  chip.close_contact();
  start(bias);
  ASSERT_TRUE(station_.wait_for("STATUS=fault: the pedal is held down", kLong)) << station_.log();
  chip.open_contact();
  ASSERT_TRUE(station_.wait_for("STATUS=ready", kLong)) << station_.log();
  EXPECT_EQ(results_in(station_.store()), 0);
}

TEST_F(StationWithPedal, LosesItsChipAndTakesItBack) {
  GpioChip chip("pedal", "board", 3, "foot");
  start(kGpio);
  ASSERT_TRUE(station_.wait_for("STATUS=ready", kLong)) << station_.log();
  for (int round = 0; round < 3; ++round) {
    chip.unplug();
    ASSERT_TRUE(station_.wait_for("STATUS=fault: the GPIO chip of the pedal left", 3s))
        << station_.log();
    chip.plug_in();
    ASSERT_TRUE(station_.wait_for("STATUS=ready", 3s)) << station_.log();
  }
  chip.close_contact();
  ASSERT_TRUE(station_.wait_for("STATUS=capturing", kLong)) << station_.log();
}

TEST_F(StationWithPedal, SaysWhoHoldsItsLineAndTakesItWhenItIsFree) {
  GpioChip chip("pedal", "board", 3, "foot");
  GpioPedal::Settings same_line;
  same_line.address.line = "foot";
  auto holder = GpioPedal::open(same_line);
  ASSERT_TRUE(holder);
  start(kGpio);
  ASSERT_TRUE(station_.wait_for("is held by \"instep pedal\"", kLong)) << station_.log();
  holder->reset();
  ASSERT_TRUE(station_.wait_for("STATUS=ready", kLong)) << station_.log();
}

TEST_F(StationWithPedal, ScansWhenAFootSwitchTypesItsKey) {
  FootSwitch foot_switch;
  start(kEvdev);
  ASSERT_TRUE(station_.wait_for("STATUS=ready", kLong)) << station_.log();
  foot_switch.unplug();
  ASSERT_TRUE(station_.wait_for("STATUS=fault: the pedal 0c45:7403 left", 3s)) << station_.log();
  foot_switch.plug_in();
  ASSERT_TRUE(station_.wait_for("STATUS=ready", 3s)) << station_.log();
  constexpr unsigned kKeyB = 48;
  foot_switch.send(kKeyB, 1);
  ASSERT_TRUE(station_.wait_for("STATUS=capturing", kLong)) << station_.log();
}

}  // namespace
}  // namespace instep::test
