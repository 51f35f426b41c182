#include "daemon/command_line/calibration_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace instep {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string said_of(PosesUse use, bool is_written) {
  CalibrationReport report;
  report.use = use;
  if (is_written) report.file = "/srv/poses.toml";
  return to_text(report);
}

TEST(CalibrationReport, SaysWhatComesOfThePoses) {
  EXPECT_THAT(said_of(PosesUse::kOfStation, true),
              AllOf(HasSubstr("written to /srv/poses.toml"), HasSubstr("restart instepd")));
  EXPECT_THAT(said_of(PosesUse::kInFile, true),
              AllOf(HasSubstr("written to /srv/poses.toml\n"), Not(HasSubstr("instepd"))));
  EXPECT_THAT(said_of(PosesUse::kPrinted, false), HasSubstr("--out FILE"));
  EXPECT_THAT(said_of(PosesUse::kNeedless, false),
              AllOf(HasSubstr("nothing is written"), Not(HasSubstr("--out"))));
  EXPECT_THAT(said_of(PosesUse::kNotWritten, false),
              AllOf(HasSubstr("nothing is written"), Not(HasSubstr("--out"))));
}

}  // namespace
}  // namespace instep
