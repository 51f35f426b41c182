#pragma once

#include <gtest/gtest.h>

#include "drivers/output_line.h"

namespace instep::test {

/// What drivers/output_line.h promises, for any backend. A backend is a default-constructible type
/// with one line whose device is plugged in:
///
///     Result<std::unique_ptr<OutputLine>> open();
///     bool is_on() const;                what the device itself says of the line
///     void unplug();    void plug_in();  the device leaves and comes back
///
/// and runs the suite by INSTANTIATE_TYPED_TEST_SUITE_P(Name, OutputContract, Backend).
template <typename Backend>
class OutputContract : public testing::Test {
 protected:
  Backend backend_;
};

TYPED_TEST_SUITE_P(OutputContract);

TYPED_TEST_P(OutputContract, IsOffUntilItIsSet) {
  const auto line = this->backend_.open();
  ASSERT_TRUE(line) << line.error().line();
  EXPECT_FALSE(this->backend_.is_on());
}

TYPED_TEST_P(OutputContract, FollowsWhatIsSet) {
  const auto line = this->backend_.open();
  ASSERT_TRUE(line) << line.error().line();
  for (const bool on : {true, true, false, false, true}) {
    ASSERT_TRUE((*line)->set(on));
    EXPECT_EQ(this->backend_.is_on(), on);
  }
}

TYPED_TEST_P(OutputContract, IsPutOffAtItsEnd) {
  for (int round = 0; round < 2; ++round) {
    auto line = this->backend_.open();
    ASSERT_TRUE(line) << line.error().line();
    ASSERT_TRUE((*line)->set(true));
    line->reset();
    EXPECT_FALSE(this->backend_.is_on());
  }
}

TYPED_TEST_P(OutputContract, SaysThatItLeftAndCanBeHadAgain) {
  auto line = this->backend_.open();
  for (int round = 0; round < 3; ++round) {
    ASSERT_TRUE(line) << line.error().line();
    ASSERT_TRUE((*line)->set(true));
    this->backend_.unplug();
    const auto gone = (*line)->set(true);
    ASSERT_FALSE(gone);
    EXPECT_EQ(gone.error().code, ErrorCode::kDeviceGone);
    EXPECT_FALSE(this->backend_.open()) << "it is still away";
    this->backend_.plug_in();
    EXPECT_FALSE((*line)->set(true)) << "what left is gone for good";
    line->reset();
    line = this->backend_.open();
    EXPECT_FALSE(this->backend_.is_on());
  }
}

REGISTER_TYPED_TEST_SUITE_P(OutputContract, IsOffUntilItIsSet, FollowsWhatIsSet, IsPutOffAtItsEnd,
                            SaysThatItLeftAndCanBeHadAgain);

}  // namespace instep::test
