#include <grp.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/kernel/devices/foot_switch.h"
#include "tests/kernel/devices/gpio_chip.h"
#include "tests/support/places.h"

namespace instep::test {
namespace {

/// The real udevd, with the rules that are installed.
class UdevRules : public testing::Test {
 protected:
  UdevRules() {
    std::filesystem::create_directories("/run/udev/rules.d");
    std::filesystem::copy_file(source_tree() / "config/70-instep.rules", kInstalled);
    settle("control --reload");
  }
  ~UdevRules() override {
    std::filesystem::remove(kInstalled);
    settle("control --reload");
  }

  static void settle(const std::string& first) {
    const std::string command = "udevadm " + first + " && udevadm settle --timeout=30";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }

  /// Such as "plugdev 660".
  static std::string access_to(const std::string& node) {
    settle("control --ping");
    struct stat status {};
    if (stat(node.c_str(), &status) != 0) return "nothing";
    const group* owner = getgrgid(status.st_gid);
    char mode[8];
    std::snprintf(mode, sizeof mode, "%o", status.st_mode & 0777U);
    return std::string(owner == nullptr ? "?" : owner->gr_name) + " " + mode;
  }

  static constexpr const char* kInstalled = "/run/udev/rules.d/70-instep.rules";
};

TEST_F(UdevRules, OpenGpioChipsToTheDaemon) {
  const GpioChip chip("pedal", "board", 3, "foot");
  EXPECT_EQ(access_to("/dev/" + chip.node()), "plugdev 660");
}

TEST_F(UdevRules, OpenFootSwitchesToTheDaemonAndNoOtherKeyboard) {
  const FootSwitch known(0x7403);
  EXPECT_EQ(access_to(known.node()), "plugdev 660");
  const FootSwitch unknown(0x1234);
  EXPECT_EQ(access_to(unknown.node()).substr(0, 7), "input 6");
}

}  // namespace
}  // namespace instep::test
