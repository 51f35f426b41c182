#include "daemon/station/recovery_ladder.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

using Step = RecoveryLadder::Step;

Error error(ErrorCode code) {
  return {code, usual_remedy(code), "", ""};
}

const Error kSilent{ErrorCode::kTimeout, Remedy::kReopen, "", ""};

// From gentle to rough, each rung a few times, and never without end.
TEST(RecoveryLadder, ReopensThenResetsThenCallsAPerson) {
  RecoveryLadder ladder(true);
  EXPECT_EQ(ladder.text(), "");
  for (int i = 0; i < RecoveryLadder::kReopens; ++i)
    EXPECT_EQ(ladder.failed(kSilent), Step::kReopen);
  EXPECT_EQ(ladder.text(), "opened again, 3 of 3");
  for (int i = 0; i < RecoveryLadder::kResets; ++i) EXPECT_EQ(ladder.failed(kSilent), Step::kReset);
  EXPECT_EQ(ladder.text(), "USB reset 2 of 2");
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(ladder.failed(kSilent), Step::kOperator);
  EXPECT_EQ(ladder.text(), "needs a person");
}

TEST(RecoveryLadder, BeginsAtItsFootAfterRecovery) {
  RecoveryLadder ladder(true);
  for (int i = 0; i < 20; ++i) ladder.failed(kSilent);
  ladder.recovered();
  EXPECT_EQ(ladder.text(), "");
  EXPECT_EQ(ladder.failed(kSilent), Step::kReopen);
}

TEST(RecoveryLadder, NeverResetsWhatCannotBeReset) {
  RecoveryLadder ladder(false);
  for (int i = 0; i < 20; ++i) EXPECT_NE(ladder.failed(kSilent), Step::kReset);
}

TEST(RecoveryLadder, ResetsAtOnceWhereThatIsTheRemedy) {
  RecoveryLadder ladder(true);
  EXPECT_EQ(ladder.failed({ErrorCode::kCorruptData, Remedy::kReset, "", ""}), Step::kReset);
}

TEST(RecoveryLadder, ResetsNeitherWhatIsAwayNorWhatAnotherProgramHas) {
  for (const auto code : {ErrorCode::kDeviceGone, ErrorCode::kNotFound, ErrorCode::kBusy,
                          ErrorCode::kPermissionDenied, ErrorCode::kNoBandwidth}) {
    RecoveryLadder ladder(true);
    for (int i = 0; i < 20; ++i) EXPECT_NE(ladder.failed(error(code)), Step::kReset);
  }
}

// A sound sensor that takes six seconds to open would be reset while it does.
TEST(RecoveryLadder, StaysOnItsRungWhileACameraIsStillOpening) {
  RecoveryLadder ladder(true);
  ladder.failed(kSilent);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(ladder.failed(error(ErrorCode::kTimeout)), Step::kReopen);
  }
  EXPECT_EQ(ladder.text(), "opened again, 1 of 3");
  ladder.failed(error(ErrorCode::kNotFound));
  ladder.failed(error(ErrorCode::kTimeout));
  EXPECT_EQ(ladder.text(), "waits until it is plugged in");
}

// A camera that is away for a night must not be given up.
TEST(RecoveryLadder, WaitsWithoutEndForWhatIsAway) {
  RecoveryLadder ladder(true);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(ladder.failed(error(ErrorCode::kDeviceGone)), Step::kReopen);
  }
  EXPECT_EQ(ladder.text(), "waits until it is plugged in");
}

}  // namespace
}  // namespace instep
