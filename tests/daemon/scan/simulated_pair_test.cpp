#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "daemon/scan/scan_pipeline.h"
#include "sim/simulated_station.h"
#include "tests/support/simulated_scan.h"

namespace instep {
namespace {

using test::is_said;
using test::scan_of;

bool is_withheld(const std::string& id, const MeasureSet& measures) {
  return std::any_of(measures.withheld.begin(), measures.withheld.end(),
                     [&id](const auto& one) { return one.id == id && !one.reason.empty(); });
}

/// The lower part of their inner sides nobody sees: the girths there are not sure.
TEST(SimulatedPair, HasIntervalsThatHoldWhereOneFootHidesTheOther) {
  for (const std::uint64_t seed : {7U, 9U}) {
    SimulationSettings settings;
    settings.seed = seed;
    settings.subject = Subject::kFeet;
    auto scan = scan_of(settings);
    ASSERT_TRUE(scan);
    // That a side was given, and is of no use here, is said and not passed over.
    PipelineSettings pipeline;
    if (seed == 7U) pipeline.side = Side::kLeft;
    const auto records = measure_capture(scan->capture, pipeline, {});
    ASSERT_TRUE(records) << records.error().line();
    ASSERT_EQ(records->size(), 2U);
    EXPECT_EQ(is_said("the side that was given was not used", records->front().warnings),
              pipeline.side.has_value());
    EXPECT_NE(records->front().foot.side, records->back().foot.side);
    for (std::size_t i = 0; i < 2; ++i) {
      const Measure* ball = (*records)[i].measures.find("ball_girth");
      ASSERT_NE(ball, nullptr) << seed;
      ASSERT_TRUE(ball->u95_mm);
      const double truth = scan->truth[i].measures.at("ball_girth");
      EXPECT_NEAR(ball->value_mm, truth, *ball->u95_mm) << seed;
      EXPECT_TRUE(is_said("the wall of the foot was not seen", ball->warnings)) << seed;
    }
  }
}

TEST(SimulatedPair, IsPutSideBySideAndLedByTheLongerFoot) {
  SimulationSettings settings;
  settings.seed = 3;
  settings.subject = Subject::kFeet;
  auto scan = scan_of(settings);
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->truth.size(), 2U);
  const double true_left = scan->truth.front().measures.at("foot_length");
  const double true_right = scan->truth.back().measures.at("foot_length");
  ASSERT_GT(true_left, true_right + 1.0);

  const auto records = measure_capture(scan->capture, {}, {});
  ASSERT_TRUE(records) << records.error().line();
  ASSERT_EQ(records->size(), 2U);
  for (const auto& record : *records) {
    ASSERT_TRUE(record.pair);
    EXPECT_EQ(record.pair->left_id, records->front().id);
    EXPECT_EQ(record.pair->right_id, records->back().id);
    EXPECT_EQ(record.pair->feet.leading(), Side::kLeft);
    const MeasurePair* length = record.pair->feet.find("foot_length");
    ASSERT_NE(length, nullptr);
    EXPECT_NEAR(length->difference_mm(), true_right - true_left, 1.0);
    EXPECT_EQ(record.pair->sizes.mondopoint_mm, records->front().sizes.mondopoint_mm);
    EXPECT_TRUE(is_said("no camera saw the sole", record.foot.warnings));
    EXPECT_FALSE(is_said("the sole", record.warnings)) << "of one foot, with both";
  }
}

/// No camera sees the lower part of the inner walls, nor anything of them behind the arch; what is
/// told of these all the same has to be right.
TEST(SimulatedPair, HasItsBallGirthsThoughTheInnerWallsAreHidden) {
  SimulationSettings settings;
  settings.subject = Subject::kFeet;
  for (const std::uint64_t seed : {3U, 6U}) {
    settings.seed = seed;
    auto scan = scan_of(settings);
    ASSERT_TRUE(scan);
    const auto records = measure_capture(scan->capture, {}, {});
    ASSERT_TRUE(records) << records.error().line();
    ASSERT_EQ(records->size(), 2U);
    for (std::size_t foot = 0; foot < 2; ++foot) {
      const auto& measures = (*records)[foot].measures;
      const Measure* girth = measures.find("ball_girth");
      ASSERT_NE(girth, nullptr);
      ASSERT_TRUE(girth->u95_mm);
      const double error = girth->value_mm - scan->truth[foot].measures.at("ball_girth");
      EXPECT_LT(std::abs(error), 2.0) << seed << " " << foot;
      EXPECT_LT(std::abs(error), *girth->u95_mm) << seed << " " << foot;
      EXPECT_TRUE(is_said("the wall of the foot was not seen", girth->warnings));
      for (const char* id : {"toe1_angle", "ankle_girth", "heel_breadth"}) {
        const Measure* measure = measures.find(id);
        if (measure == nullptr) {
          EXPECT_TRUE(is_withheld(id, measures)) << id;
          continue;
        }
        ASSERT_TRUE(measure->u95()) << id;
        EXPECT_NEAR(measure->value(), scan->truth[foot].measures.at(id), *measure->u95()) << id;
      }
    }
  }
}

TEST(SimulatedPair, IsNoneForASingleFoot) {
  SimulationSettings settings;
  auto scan = scan_of(settings);
  ASSERT_TRUE(scan);
  const auto records = measure_capture(scan->capture, {}, {});
  ASSERT_TRUE(records) << records.error().line();
  ASSERT_EQ(records->size(), 1U);
  EXPECT_FALSE(records->front().pair);
}

}  // namespace
}  // namespace instep
