#include "config/calibration/applied_calibration.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

AppliedCalibration calibration() {
  AppliedCalibration calibration;
  calibration.file = "/etc/c.toml";
  calibration.time = "2026-11-28T02:11:12Z";
  return calibration;
}

TEST(AppliedCalibration, SaysWhichCamerasItPlaced) {
  auto all = calibration();
  all.placed = {"left", "right"};
  EXPECT_EQ(describe(all),
            "poses    left, right as calibrated at 2026-11-28T02:11:12Z, /etc/c.toml\n");
  EXPECT_EQ(what_is_lacking(all), "");
}

TEST(AppliedCalibration, NamesThoseThatItLacksAndThoseThatNobodyHas) {
  auto some = calibration();
  some.placed = {"left"};
  some.left_out = {"right", "top"};
  some.unknown = {"front", "back"};
  EXPECT_EQ(describe(some),
            "poses    left as calibrated at 2026-11-28T02:11:12Z, /etc/c.toml\n"
            "poses    right, top as the settings say, for want of calibration: instep calibrate\n"
            "poses    of front, back are calibrated too, but no [[camera]] is called so\n");
  EXPECT_EQ(what_is_lacking(some), "/etc/c.toml does not hold right, top");
  some.placed.clear();
  EXPECT_EQ(describe(some).rfind("poses    no camera as calibrated at ", 0), 0U) << describe(some);
}

TEST(AppliedCalibration, IsNotUsedWhereNoCameraIsReal) {
  auto idle = calibration();
  idle.unknown = {"left"};
  EXPECT_EQ(describe(idle),
            "poses    simulated and recorded cameras bring their own; /etc/c.toml is not used\n");
  EXPECT_EQ(what_is_lacking(idle), "");
}

}  // namespace
}  // namespace instep
