#include "daemon/command_line/doctor/doctor_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace instep {
namespace {

TEST(DoctorReport, TellsWhatWasNotLookedAtFromWhatIsGoodAndFromWhatIsWrong) {
  const std::vector<DoctorCheck> checks{
      good_check("disk", "is large"), bad_check("store", "is gone", "bring it back"),
      unseen_check("pedal", "not looked at: it is another's", "sudo -u instep instep doctor")};
  EXPECT_EQ(to_text(checks),
            "ok    disk        is large\n"
            "WRONG store       is gone\n"
            "                  -> bring it back\n"
            "?     pedal       not looked at: it is another's\n"
            "                  -> sudo -u instep instep doctor\n");
  const auto list = to_json(checks).at("checks");
  EXPECT_EQ(list.at(0).at("good"), true);
  EXPECT_EQ(list.at(1).at("good"), false);
  EXPECT_TRUE(list.at(2).at("good").is_null());
  EXPECT_EQ(list.at(2).at("remedy"), "sudo -u instep instep doctor");
}

}  // namespace
}  // namespace instep
