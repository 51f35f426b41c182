#include "daemon/machine/inventory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "daemon/machine/inventory_report.h"
#include "tests/support/fake_usb_bus.h"
#include "tests/support/openni_bus.h"

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
    return take_inventory(settings_, {bus_.sysfs(), bus_.dev()}, linux_video_system(), openni_);
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

  void write_openni_sensor(const std::string& port, const std::string& number) const {
    write(bus_.usb_folder(port) / "idVendor", "1d27");
    write(bus_.usb_folder(port) / "busnum", "1");
    write(bus_.usb_folder(port) / "devnum", number);
  }
  static OpenniDevice told(const std::string& uri) {
    OpenniDevice sensor;
    sensor.uri = uri;
    return sensor;
  }
  static OpenniDevice in_use(const std::string& uri) {
    OpenniDevice sensor = told(uri);
    sensor.trouble = "it is in use";
    return sensor;
  }
  void configure_openni(const std::string& serial) {
    settings_.cameras[0].kind = CameraKind::kOpenni;
    settings_.cameras[0].openni.serial = serial;
    settings_.cameras[0].openni.placement.name = "heel";
  }

  test::FakeUsbBus bus_;
  Settings settings_;
  OpenniSight openni_;
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
  write_openni_sensor("2", "12");
  const auto inventory = take();
  ASSERT_EQ(inventory.cameras.size(), 3U);
  EXPECT_EQ(inventory.cameras[2].kind, "openni2");
  EXPECT_THAT(inventory.cameras[2].nodes, ElementsAre(bus_.dev() / "bus/usb/001/012"));
}

// The number in the descriptor, "A1" and "B2" here, is not always the one that OpenNI2 tells.
TEST_F(InventoryOfAMachine, KnowsTheConfiguredSensorByTheNumberThatOpenniTells) {
  write_openni_sensor("2", "12");
  write_openni_sensor("4.3", "7");
  configure_openni("1210240012");
  openni_.sensors = {told("1d27/0609@1/7"), in_use("1d27/0609@1/12")};
  openni_.sensors[0].serial = "1210240012";
  openni_.sensors[0].modes = {{640, 480, 30, 0.1}, {640, 480, 25, 0.1}, {320, 240, 30, 1.0}};
  const auto inventory = take();
  ASSERT_EQ(inventory.cameras.size(), 4U);
  const auto& busy = inventory.cameras[2];
  EXPECT_EQ(busy.device.address, (UsbAddress{"usb-0000:00:14.0-2", "A1"}));
  EXPECT_EQ(busy.trouble, "it is in use");
  EXPECT_EQ(busy.configured_as, "");
  const auto& heel = inventory.cameras[3];
  EXPECT_EQ(heel.device.address, (UsbAddress{"usb-0000:00:14.0-4.3", "1210240012"}));
  EXPECT_EQ(heel.configured_as, "heel");
  ASSERT_EQ(heel.modes.size(), 2U);
  EXPECT_EQ(heel.modes[0].format, "0.1 mm");
  EXPECT_THAT(heel.modes[0].sizes, ElementsAre("640x480"));
  const auto text = to_text(inventory, settings_);
  EXPECT_THAT(text, HasSubstr("    cannot be used now: it is in use\n"));
  EXPECT_THAT(text, HasSubstr("kind \"openni2\", 480 Mbit/s (it could be faster: use a USB 3 "
                              "socket), configured as heel\n"));
}

// While the daemon has its sensor nobody else can ask it for its number.
TEST_F(InventoryOfAMachine, KnowsASensorInUseByItsDescriptorOrAsTheOnlyOne) {
  write_openni_sensor("2", "12");
  openni_.sensors = {in_use("1d27/0609@1/12")};
  configure_openni("A1");
  EXPECT_EQ(take().cameras.back().configured_as, "heel");
  configure_openni("");
  EXPECT_EQ(take().cameras.back().configured_as, "heel");
  write_openni_sensor("4.3", "7");
  EXPECT_EQ(take().cameras[2].configured_as, "");
  EXPECT_EQ(take().cameras[3].configured_as, "");
}

TEST_F(InventoryOfAMachine, ShowsWhatTheRealLibrarySeesAndWhyItSeesNothing) {
  test::OpenniBus openni_bus;
  openni_bus.plug_in({.serial = "S7"});
  configure_openni("S7");
  settings_.cameras[0].openni.library_folder = openni_bus.folder();
  settings_.cameras.push_back(settings_.cameras[0]);
  settings_.cameras[1].openni.library_folder = "/nowhere";
  openni_ = look_through_openni(settings_, openni_bus.program().file, std::chrono::seconds(20));
  const auto inventory = take();
  const auto sensor =
      std::find_if(inventory.cameras.begin(), inventory.cameras.end(),
                   [](const auto& one) { return one.device.address.serial == "S7"; });
  ASSERT_NE(sensor, inventory.cameras.end());
  EXPECT_EQ(sensor->configured_as, "heel");
  EXPECT_FALSE(sensor->modes.empty());
  const auto json = to_json(inventory, settings_);
  EXPECT_THAT(json["openni_troubles"].dump(), HasSubstr("there is no libOpenNI2.so.0 in /nowhere"));
  const auto text = to_text(inventory, settings_);
  EXPECT_THAT(text, HasSubstr(", serial S7\n    kind \"openni2\", not on USB, configured as heel"));
  EXPECT_THAT(text, HasSubstr("  OpenNI2 lists no sensors: there is no libOpenNI2.so.0"));
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

TEST_F(InventoryOfAMachine, SaysWhatALineIsFor) {
  GpioChipState board;
  board.label = "board";
  board.lines = {{1, "foot", ""}, {2, "", "someone"}, {3, "lamp", ""}, {4, "else", ""}};
  settings_.pedal.kind = PedalKind::kGpio;
  settings_.pedal.gpio.place.line = "foot";
  settings_.outputs.busy_lamp.emplace().place.line = "lamp";
  auto& projector = settings_.outputs.projector.emplace().place;
  projector.chip = "board";
  projector.offset = 2;
  Inventory inventory;
  inventory.gpio_chips = {board};
  const auto lines = to_json(inventory, settings_)["gpio_chips"][0]["lines"];
  const std::vector<std::string> uses = {"pedal", "projector", "lamp.busy"};
  for (std::size_t i = 0; i < uses.size(); ++i) EXPECT_EQ(lines[i]["configured_as"], uses[i]);
  EXPECT_TRUE(lines[3]["configured_as"].is_null());
  projector.chip = "another board";
  EXPECT_EQ(use_of_line(settings_, board, board.lines[1]), "");
  EXPECT_THAT(to_text(inventory, settings_), HasSubstr("3 \"lamp\", the lamp.busy\n"));
}

TEST_F(InventoryOfAMachine, SaysWhyAChipCannotBeOpened) {
  Inventory inventory;
  inventory.gpio_chips = {{"/dev/gpiochip0", "", 0, {}, true, "Too many open files"},
                          {"/dev/gpiochip1", "", 0, {}, false, ""}};
  EXPECT_THAT(to_text(inventory, settings_),
              HasSubstr("  /dev/gpiochip0 cannot be opened: Too many open files\n"
                        "  /dev/gpiochip1: you may not open it\n"));
  const auto chips = to_json(inventory, settings_)["gpio_chips"];
  EXPECT_EQ(chips[0]["trouble"], "Too many open files");
  EXPECT_TRUE(chips[1]["trouble"].is_null());
}

TEST_F(InventoryOfAMachine, IsEmptyWhereTheKernelShowsNothing) {
  const auto inventory =
      take_inventory(settings_, {"/nowhere", "/nowhere"}, linux_video_system(), {});
  EXPECT_TRUE(inventory.cameras.empty());
  EXPECT_TRUE(inventory.gpio_chips.empty());
  EXPECT_TRUE(inventory.foot_switches.empty());
}

}  // namespace
}  // namespace instep
