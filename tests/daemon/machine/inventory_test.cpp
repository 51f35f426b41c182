#include "daemon/machine/inventory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "daemon/machine/inventory_report.h"
#include "tests/support/fake_usb_bus.h"

namespace instep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class InventoryOfAMachine : public testing::Test {
 protected:
  InventoryOfAMachine() {
    bus_.plug({.port = "2", .serial = "A1", .nodes = {0, 1}});
    bus_.plug({.port = "4.3", .serial = "B2", .nodes = {2}, .usb_version = " 3.20"});
    settings_.cameras.resize(1);
    settings_.cameras[0].kind = CameraKind::kV4l2;
    settings_.cameras[0].v4l2.serial = "B2";
    settings_.cameras[0].v4l2.placement.name = "left";
  }

  Inventory take() const {
    return take_inventory(settings_, {bus_.sysfs(), bus_.dev()}, linux_video_system());
  }

  void write(const std::filesystem::path& file, const std::string& text) const {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text << "\n";
  }
  /// An input device as the kernel shows it: event<number>.
  void plug_input(int number, const std::string& bus, const std::string& keys) const {
    const std::string name = "event" + std::to_string(number);
    const auto device = bus_.sysfs() / "class/input" / name / "device";
    write(device / "name", "Foot switch");
    write(device / "id/bustype", bus);
    write(device / "id/vendor", "0c45");
    write(device / "id/product", "7403");
    write(device / "capabilities/key", keys);
    write(bus_.dev() / "input" / name, "");
  }

  test::FakeUsbBus bus_;
  Settings settings_;
};

TEST_F(InventoryOfAMachine, PutsTheNodesOfACameraTogetherAndNamesTheConfiguredOne) {
  const auto inventory = take();
  ASSERT_EQ(inventory.cameras.size(), 2U);
  EXPECT_THAT(inventory.cameras[0].nodes,
              ElementsAre(bus_.dev() / "video0", bus_.dev() / "video1"));
  EXPECT_EQ(inventory.cameras[0].configured_as, "");
  EXPECT_EQ(inventory.cameras[1].device.address.bus_path, "usb-0000:00:14.0-4.3");
  EXPECT_EQ(inventory.cameras[1].configured_as, "left");
}

TEST_F(InventoryOfAMachine, KnowsSensorsOfOpenniByTheirMaker) {
  write(bus_.usb_folder("2") / "idVendor", "1d27");
  write(bus_.usb_folder("2") / "busnum", "1");
  write(bus_.usb_folder("2") / "devnum", "12");
  const auto inventory = take();
  ASSERT_EQ(inventory.cameras.size(), 3U);
  EXPECT_EQ(inventory.cameras[2].kind, "openni2");
  EXPECT_THAT(inventory.cameras[2].nodes, ElementsAre(bus_.dev() / "bus/usb/001/012"));
}

TEST_F(InventoryOfAMachine, ListsInputDevicesOnUsbThatHaveKeys) {
  plug_input(3, "0003", "0 10000 0");
  plug_input(4, "0003", "0 0 0");      // a joystick without keys
  plug_input(5, "0011", "0 10000 0");  // the keyboard of a laptop
  std::filesystem::create_directories(bus_.dev() / "input/by-id");
  std::filesystem::create_symlink("../event3", bus_.dev() / "input/by-id/usb-foot-event-kbd");
  settings_.pedal.kind = PedalKind::kEvdev;
  for (const char* device :
       {"0c45:7403", "usb-foot-event-kbd", "/dev/input/by-id/usb-foot-event-kbd"}) {
    settings_.pedal.evdev.device = device;
    const auto inventory = take();
    ASSERT_EQ(inventory.foot_switches.size(), 1U);
    EXPECT_EQ(inventory.foot_switches[0].path, bus_.dev() / "input/event3");
    EXPECT_EQ(inventory.foot_switches[0].by_id, "usb-foot-event-kbd");
    EXPECT_TRUE(is_pedal(settings_.pedal, inventory.foot_switches[0])) << device;
  }
  settings_.pedal.evdev.device = "0c45:7404";
  EXPECT_FALSE(is_pedal(settings_.pedal, take().foot_switches[0]));
}

TEST_F(InventoryOfAMachine, IsReportedForProgramsAndForPeople) {
  const auto inventory = take();
  const auto json = to_json(inventory, settings_);
  EXPECT_EQ(json["cameras"][1]["serial"], "B2");
  EXPECT_EQ(json["cameras"][1]["could_be_faster"], true);
  EXPECT_EQ(json["cameras"][0]["configured_as"], nullptr);
  EXPECT_TRUE(json["gpio_chips"].empty());
  const auto text = to_text(inventory, settings_);
  EXPECT_THAT(text,
              HasSubstr("serial B2, at usb-0000:00:14.0-4.3\n    kind \"v4l2\", 480 Mbit/s (it "
                        "could be faster: use a USB 3 socket), configured as left\n"));
  EXPECT_THAT(text, HasSubstr("GPIO chips\n  none\n"));
}

TEST_F(InventoryOfAMachine, IsEmptyWhereTheKernelShowsNothing) {
  const auto inventory = take_inventory(settings_, {"/nowhere", "/nowhere"}, linux_video_system());
  EXPECT_TRUE(inventory.cameras.empty());
  EXPECT_TRUE(inventory.gpio_chips.empty());
  EXPECT_TRUE(inventory.foot_switches.empty());
}

}  // namespace
}  // namespace instep
