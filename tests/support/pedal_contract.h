#pragma once

#include <gtest/gtest.h>
#include <poll.h>

#include "drivers/pedal.h"

namespace instep::test {

/// What drivers/pedal.h promises, for any backend. A backend is a default-constructible type with a
/// pedal at rest and a foot:
///
///     Pedal& pedal();
///     void press();    void release();   clean edges, no chatter
///     void unplug();   void plug_in();   the device leaves and comes back
///
/// and runs the suite by INSTANTIATE_TYPED_TEST_SUITE_P(Name, PedalContract, Backend).
template <typename Backend>
class PedalContract : public testing::Test {
 protected:
  bool readable(int limit_ms) {
    pollfd waiting{backend_.pedal().descriptor(), POLLIN, 0};
    return poll(&waiting, 1, limit_ms) == 1 && (waiting.revents & POLLIN) != 0;
  }

  Backend backend_;
};

TYPED_TEST_SUITE_P(PedalContract);

TYPED_TEST_P(PedalContract, RestsWithoutEdges) {
  EXPECT_FALSE(this->readable(0));
  const auto edges = this->backend_.pedal().read_edges();
  ASSERT_TRUE(edges) << edges.error().line();
  EXPECT_TRUE(edges->empty());
  EXPECT_FALSE(this->backend_.pedal().is_pressed().value());
}

TYPED_TEST_P(PedalContract, ReportsPressAndRelease) {
  std::chrono::nanoseconds last{0};
  for (const bool pressed : {true, false, true, false}) {
    pressed ? this->backend_.press() : this->backend_.release();
    ASSERT_TRUE(this->readable(5000));
    const auto edges = this->backend_.pedal().read_edges();
    ASSERT_TRUE(edges) << edges.error().line();
    ASSERT_EQ(edges->size(), 1U);
    EXPECT_EQ(edges->front().pressed, pressed);
    EXPECT_GT(edges->front().time, last);
    last = edges->front().time;
    EXPECT_EQ(this->backend_.pedal().is_pressed().value(), pressed);
    EXPECT_FALSE(this->readable(0)) << "all edges were read";
  }
}

TYPED_TEST_P(PedalContract, KeepsEdgesThatNobodyRead) {
  this->backend_.press();
  this->backend_.release();
  this->backend_.press();
  std::vector<PedalEdge> all;
  while (all.size() < 3 && this->readable(5000)) {
    const auto edges = this->backend_.pedal().read_edges();
    ASSERT_TRUE(edges) << edges.error().line();
    all.insert(all.end(), edges->begin(), edges->end());
  }
  ASSERT_EQ(all.size(), 3U);
  EXPECT_TRUE(all[0].pressed);
  EXPECT_FALSE(all[1].pressed);
  EXPECT_TRUE(all[2].pressed);
  EXPECT_LT(all[0].time, all[1].time);
  EXPECT_LT(all[1].time, all[2].time);
}

TYPED_TEST_P(PedalContract, UsesTheMonotonicClock) {
  const auto now = [] {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
        std::chrono::steady_clock::now().time_since_epoch());
  };
  const auto before = now();
  this->backend_.press();
  ASSERT_TRUE(this->readable(5000));
  const auto edges = this->backend_.pedal().read_edges();
  ASSERT_TRUE(edges && edges->size() == 1);
  EXPECT_GE(edges->front().time, before);
  EXPECT_LE(edges->front().time, now());
}

TYPED_TEST_P(PedalContract, SaysThatItLeftAndComesBack) {
  for (int round = 0; round < 3; ++round) {
    this->backend_.unplug();
    ASSERT_TRUE(this->readable(5000));
    const auto gone = this->backend_.pedal().read_edges();
    ASSERT_FALSE(gone);
    EXPECT_EQ(gone.error().code, ErrorCode::kDeviceGone);
    EXPECT_EQ(gone.error().remedy, Remedy::kReopen);
    EXPECT_FALSE(this->backend_.pedal().reopen()) << "it is still away";
    this->backend_.plug_in();
    const auto reopened = this->backend_.pedal().reopen();
    ASSERT_TRUE(reopened) << reopened.error().line();
    EXPECT_FALSE(this->readable(0));
    this->backend_.press();
    ASSERT_TRUE(this->readable(5000));
    EXPECT_EQ(this->backend_.pedal().read_edges().value().size(), 1U);
    this->backend_.release();
    ASSERT_TRUE(this->readable(5000));
    EXPECT_EQ(this->backend_.pedal().read_edges().value().size(), 1U);
  }
}

REGISTER_TYPED_TEST_SUITE_P(PedalContract, RestsWithoutEdges, ReportsPressAndRelease,
                            KeepsEdgesThatNobodyRead, UsesTheMonotonicClock,
                            SaysThatItLeftAndComesBack);

}  // namespace instep::test
