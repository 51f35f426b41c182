#include <gtest/gtest.h>

#include <cmath>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "tests/support/cases/drawn_feet.h"

namespace instep {
namespace {

/// Simulated feet with noise, holes and a leg, in any pose, whose truth the solid itself gives.
class DrawnFeet : public testing::TestWithParam<std::uint64_t> {};

TEST_P(DrawnFeet, HaveAllTheirMeasuresWithinTheBars) {
  const auto drawn = test::draw_scanned_foot(GetParam());
  SCOPED_TRACE(drawn.making);
  const auto foot = align_foot(drawn.cloud).and_then(find_landmarks);
  ASSERT_TRUE(foot) << foot.error().line();
  EXPECT_EQ(foot->side, drawn.truth.side);
  const auto set = measure_foot(*foot);
  ASSERT_TRUE(set) << set.error().line();
  for (const auto& [id, truth] : drawn.truth.measures) {
    const Measure* measure = set->find(id);
    ASSERT_NE(measure, nullptr) << id;
    const auto u95 = measure->u95();
    ASSERT_TRUE(u95) << id;
    EXPECT_GT(*u95, 0.0) << id;
    // Three standard deviations and what the rules themselves may be off by.
    EXPECT_NEAR(measure->value(), truth, 1.5 * *u95 + 0.6) << id;
  }
  EXPECT_NEAR(set->find("foot_length")->value_mm, drawn.truth.measures.at("foot_length"), 0.7);
  for (const char* id : {"ball_girth", "waist_girth", "instep_girth", "long_heel_girth"}) {
    EXPECT_NEAR(set->find(id)->value_mm, drawn.truth.measures.at(id), 1.0) << id;
    const auto& parts = set->find(id)->parts;
    ASSERT_TRUE(parts) << id;
    EXPECT_NEAR(std::hypot(parts->surface, parts->landmarks), *set->find(id)->u95_mm, 1e-9) << id;
  }
  // Where the skin turns under the sole, what all redraws share is a part of the radius.
  const RigidTransform true_from_found = drawn.truth.foot_from_solid *
                                         drawn.input_from_solid.inverse() *
                                         foot->foot_from_input.inverse();
  for (const auto& [name, true_name] :
       {std::pair("metatarsale_fibulare", "mf"), {"toe1_tip", "toe1_tip"}}) {
    const Landmark& landmark = foot->landmarks.at(name);
    const double off =
        (true_from_found * landmark.position_mm - drawn.truth.landmarks.at(true_name)).norm();
    ASSERT_TRUE(landmark.radius_mm) << name;
    EXPECT_LE(off, 1.5 * *landmark.radius_mm) << name;  // as of the measures
  }
}

// Strays stand under the arches of the last two.
INSTANTIATE_TEST_SUITE_P(Seeds, DrawnFeet, testing::Values(12, 13, 15, 529, 532));

// One 7 mm beside the arch drew the sole out to it: the girth was 14 mm too long.
TEST(DrawnOpenSoles, AreNotLaidOutToAStray) {
  const auto drawn = test::draw_scanned_foot(22);
  ASSERT_FALSE(drawn.sole_is_seen);
  AlignmentOptions options;
  options.standing_plane =
      StandingPlane{Eigen::Vector3d::UnitZ(), drawn.input_from_solid.translation().z()};
  const auto foot = align_foot(drawn.cloud, options).and_then(find_landmarks);
  ASSERT_TRUE(foot) << foot.error().line();
  const auto set = measure_foot(*foot);
  ASSERT_TRUE(set) << set.error().line();
  const Measure* waist = set->find("waist_girth");
  ASSERT_NE(waist, nullptr);
  EXPECT_NEAR(waist->value(), drawn.truth.measures.at("waist_girth"), *waist->u95());
}

}  // namespace
}  // namespace instep
