#include "drivers/gpio/gpio_output.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "tests/kernel/devices/gpio_chip.h"
#include "tests/support/output_contract.h"

namespace instep::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

GpioOutput::Settings lamp(bool active_low = false) {
  GpioOutput::Settings settings;
  settings.address.line = "lamp";
  settings.active_low = active_low;
  return settings;
}

/// A line that is let go falls back to what pulls it, as a real one does. So it is pulled to "on"
/// before it is opened, and to "off" from then on.
template <bool kActiveLow>
class Backend {
 public:
  Result<std::unique_ptr<OutputLine>> open() {
    if (plugged_in_) kActiveLow ? chip_.close_contact() : chip_.open_contact();
    auto opened = GpioOutput::open(lamp(kActiveLow));
    if (!opened) return tl::make_unexpected(opened.error());
    kActiveLow ? chip_.open_contact() : chip_.close_contact();
    return std::move(*opened);
  }
  bool is_on() const { return chip_.level() != kActiveLow; }
  void unplug() {
    chip_.unplug();
    plugged_in_ = false;
  }
  void plug_in() {
    chip_.plug_in();
    plugged_in_ = true;
  }

 private:
  GpioChip chip_{"lamps", "board", 2, "lamp"};
  bool plugged_in_ = true;
};

using Backends = testing::Types<Backend<false>, Backend<true>>;
INSTANTIATE_TYPED_TEST_SUITE_P(GpioOutput, OutputContract, Backends);

/// What the kernel has been told to drive, by its own trace: level after level, as it sees them.
class DrivenLevels {
 public:
  DrivenLevels() {
    EXPECT_EQ(std::system("mountpoint -q /sys/kernel/tracing || "
                          "mount -t tracefs tracefs /sys/kernel/tracing"),
              0);
    std::ofstream(trace_) << "";
    std::ofstream(switch_) << "1";
  }
  ~DrivenLevels() { std::ofstream(switch_) << "0"; }
  std::vector<std::string> levels() const {
    std::vector<std::string> all;
    std::ifstream trace(trace_);
    for (std::string line; std::getline(trace, line);) {
      const auto set = line.find(" set ");
      if (set != std::string::npos) all.push_back(line.substr(set + 5));
    }
    return all;
  }

 private:
  std::string trace_ = "/sys/kernel/tracing/trace";
  std::string switch_ = "/sys/kernel/tracing/events/gpio/gpio_value/enable";
};

TEST(GpioOutput, IsDrivenOffBeforeItIsLetGo) {
  const GpioChip chip("lamps", "board", 2, "lamp");
  auto line = GpioOutput::open(lamp());
  ASSERT_TRUE(line);
  const DrivenLevels driven;
  ASSERT_TRUE((*line)->set(true));
  line->reset();
  EXPECT_THAT(driven.levels(), ElementsAre("1", "0"));
}

// Another program has the line.
TEST(GpioOutput, NamesWhoHoldsABusyLine) {
  const GpioChip chip("lamps", "board", 2, "lamp");
  const auto holder = GpioOutput::open(lamp());
  ASSERT_TRUE(holder);
  const auto second = GpioOutput::open(lamp());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kBusy);
  EXPECT_THAT(second.error().message, HasSubstr("\"instep output\""));
  const auto line = GpioLine::find(lamp().address);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->check_free().error().code, ErrorCode::kBusy);
}

TEST(GpioOutput, LooksWhetherItsLineIsFreeWithoutTouchingIt) {
  const GpioChip chip("lamps", "board", 2, "lamp");
  chip.open_contact();
  {
    const auto line = GpioLine::find(lamp().address);
    ASSERT_TRUE(line);
    EXPECT_TRUE(line->check_free());
  }
  EXPECT_TRUE(chip.level()) << "which an output would have put off";
}

}  // namespace
}  // namespace instep::test
