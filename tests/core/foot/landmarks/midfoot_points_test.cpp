#include "core/foot/landmarks/midfoot_points.h"

#include <gtest/gtest.h>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "tests/support/cases/drawn_feet.h"
#include "tests/support/foot_body.h"

namespace instep {
namespace {

/// Over simulated feet, whose shortest tape the solid itself gives. One foot's place may be off by
/// a millimetre or two, for the tape is stationary there; all of them may not to one side.
TEST(MidfootPoints, LieNoFurtherToTheHeelThanTheShortestTape) {
  constexpr std::uint64_t kFeet = 4;
  double off = 0.0;
  for (std::uint64_t seed = 301; seed < 301 + kFeet; ++seed) {
    const auto drawn = test::draw_scanned_foot(seed);
    AlignmentOptions options;
    if (!drawn.sole_is_seen) {
      options.standing_plane =
          StandingPlane{Eigen::Vector3d::UnitZ(), drawn.input_from_solid.translation().z()};
    }
    auto foot = align_foot(drawn.cloud, options);
    ASSERT_TRUE(foot) << drawn.making;
    mark(*foot);
    const RigidTransform true_from_found = drawn.truth.foot_from_solid *
                                           drawn.input_from_solid.inverse() *
                                           foot->foot_from_input.inverse();
    const Eigen::Vector3d found = true_from_found * foot->landmarks.at("medial_arch").position_mm;
    off += (found.x() - drawn.truth.landmarks.at("medial_arch").x()) / kFeet;
  }
  EXPECT_NEAR(off, 0.0, 0.7);
}

/// What is left of a section is the lateral strip, whose inner end is no medial border.
TEST(MidfootPoints, AreNotOnTheOtherSideWhereTheirOwnWasNotSeen) {
  for (const bool is_left : {false, true}) {
    auto cloud = test::FootBody{}.points();
    if (is_left) cloud = test::mirrored(cloud);
    const auto whole = align_foot(cloud);
    ASSERT_TRUE(whole);
    FootScan half = *whole;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < half.cloud.size(); ++i) {
      const auto& point = half.cloud.positions[i];
      const bool is_midfoot = std::abs(point.x() - 0.45 * 260.0) < 0.25 * 260.0;
      const bool is_lost = is_midfoot && point.z() < 40.0 && half.medial_sign() * point.y() > -35.0;
      if (!is_lost) kept.push_back(i);
    }
    half.cloud = half.cloud.subset(kept);
    mark(half);
    EXPECT_TRUE(half.landmarks.contains("lateral_midfoot"));
    EXPECT_FALSE(half.landmarks.contains("medial_arch"))
        << half.landmarks.at("medial_arch").position_mm.transpose();
  }
}

}  // namespace
}  // namespace instep
