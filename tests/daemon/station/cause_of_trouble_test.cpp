#include "daemon/station/cause_of_trouble.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

TEST(CauseOfTrouble, IsOneOfADeviceThatIsAwayWhateverIsThereInItsStead) {
  const auto told = [](ErrorCode code, const std::string& message) {
    return told_once("camera left", {code, usual_remedy(code), message, "do something"});
  };
  const auto left = told(ErrorCode::kDeviceGone, "it is unplugged");
  EXPECT_EQ(told(ErrorCode::kDeviceGone, "no camera with serial A1: there is only B2"), left);
  EXPECT_EQ(told(ErrorCode::kNotFound, "it is not plugged in (there is B2, C3)"), left);
  EXPECT_NE(told(ErrorCode::kPermissionDenied, "it may not be opened"), left);
  EXPECT_NE(told(ErrorCode::kIo, "it fails"), told(ErrorCode::kIo, "it fails otherwise"));
  EXPECT_NE(told_once("camera right", {ErrorCode::kDeviceGone, Remedy::kReopen, "it left", ""}),
            left);
}

}  // namespace
}  // namespace instep
