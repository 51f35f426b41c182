#include "daemon/machine/inventory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "drivers/gpio/gpio_pedal.h"
#include "tests/kernel/devices/foot_switch.h"
#include "tests/kernel/devices/gpio_chip.h"

namespace instep::test {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Not;

Inventory take(const Settings& settings) {
  return take_inventory(settings, {}, linux_video_system(), {});
}

TEST(InventoryOfTheKernel, ShowsGpioLinesWithTheirHolders) {
  const GpioChip chip("pedal", "board", 3, "foot");
  Settings settings;
  settings.pedal.kind = PedalKind::kGpio;
  settings.pedal.gpio.place.line = "foot";
  GpioPedal::Settings same_line;
  same_line.address.line = "foot";
  const auto pedal = GpioPedal::open(same_line);
  ASSERT_TRUE(pedal);
  const auto inventory = take(settings);
  ASSERT_EQ(inventory.gpio_chips.size(), 1U);
  const auto& shown = inventory.gpio_chips[0];
  EXPECT_EQ(shown.node, "/dev/" + chip.node());
  EXPECT_EQ(shown.label, "board");
  EXPECT_EQ(shown.line_count, 8U);
  ASSERT_EQ(shown.lines.size(), 1U);
  EXPECT_EQ(shown.lines[0].offset, 3U);
  EXPECT_EQ(shown.lines[0].holder, "instep pedal");
  EXPECT_EQ(use_of_line(settings, shown, shown.lines[0]), "pedal");
}

TEST(InventoryOfTheKernel, ShowsFootSwitches) {
  EXPECT_TRUE(take({}).foot_switches.empty());
  const FootSwitch foot_switch;
  const auto inventory = take({});
  ASSERT_EQ(inventory.foot_switches.size(), 1U);
  EXPECT_EQ(inventory.foot_switches[0].path, foot_switch.node());
  EXPECT_EQ(inventory.foot_switches[0].ids, "0c45:7403");
  EXPECT_TRUE(inventory.foot_switches[0].may_read);
}

// The kernel's own virtual camera has dozens of formats, two of them grey with 16 bits.
TEST(VideoModesOfTheKernel, AreThoseThatTheDriverLists) {
  ASSERT_EQ(std::system("modprobe vivid node_types=0x1 && udevadm settle --timeout=30"), 0);
  const auto modes = list_video_modes(linux_video_system(), "/dev/video0");
  ASSERT_TRUE(modes) << modes.error().line();
  const auto y16 = std::find_if(modes->begin(), modes->end(),
                                [](const VideoModes& mode) { return mode.format == "Y16"; });
  ASSERT_NE(y16, modes->end());
  EXPECT_THAT(y16->sizes, Not(IsEmpty()));
  EXPECT_THAT(y16->sizes, Contains("640x360"));
  EXPECT_EQ(list_video_modes(linux_video_system(), "/dev/video99").error().code,
            ErrorCode::kNotFound);
  EXPECT_EQ(std::system("modprobe -r vivid"), 0);
}

}  // namespace
}  // namespace instep::test
