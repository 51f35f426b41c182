#include "core/noticed.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

Error failure(ErrorCode code = ErrorCode::kInsufficientData) {
  return fail(code, "no foot stands there", "scan again").value();
}

TEST(WithWhatWasNoticed, TellsItAfterTheAdvice) {
  EXPECT_EQ(with_what_was_noticed(failure(), {}).line(), "no foot stands there: scan again");
  EXPECT_EQ(with_what_was_noticed(failure(), {"one", "two"}).advice,
            "scan again; what was noticed before: one; two");
}

TEST(WithWhatWasNoticed, OpensTheListOnceThoughItIsToldTwice) {
  EXPECT_EQ(with_what_was_noticed(with_what_was_noticed(failure(), {"one"}), {"two"}).advice,
            "scan again; what was noticed before: one; two");
}

TEST(WithWhatWasNoticed, LeavesWhatWasCancelledAsItIs) {
  EXPECT_EQ(with_what_was_noticed(failure(ErrorCode::kCancelled), {"one"}).advice, "scan again");
}

}  // namespace
}  // namespace instep
