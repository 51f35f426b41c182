#include "core/foot/standing/standing_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/cases/drawn_feet.h"

namespace instep {
namespace {

/// Simulated feet whose soles were seen, without strays, in any pose; the floor's normal is the
/// drawing's own.
class StandingPlaneOf : public testing::TestWithParam<std::uint64_t> {};

TEST_P(StandingPlaneOf, IsTheFloorOfAFootInAnyPose) {
  const auto drawn = test::draw_scanned_foot_without_truth(GetParam());
  SCOPED_TRACE(drawn.making);
  ASSERT_TRUE(drawn.sole_is_seen);
  const auto plane = find_standing_plane(drawn.cloud.positions);
  ASSERT_TRUE(plane) << plane.error().line();
  const Eigen::Vector3d up = drawn.input_from_solid.linear().col(2);
  EXPECT_LT(std::acos(std::min(1.0, up.dot(plane->up))) * 180.0 / std::numbers::pi, 1.0);
  EXPECT_NEAR(plane->up.dot(drawn.input_from_solid.translation()), plane->height_mm, 0.5);
}

// The outer sides of the first two are nearly as large as their soles, and flat.
INSTANTIATE_TEST_SUITE_P(Seeds, StandingPlaneOf, testing::Values(1067, 459, 301, 307, 338));

}  // namespace
}  // namespace instep
