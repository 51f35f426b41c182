#include "core/girth/tape_plane.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace instep {
namespace {

using Eigen::Vector3d;

TEST(TapePlane, SpansARightHandedFrameOnItsThreePoints) {
  const auto plane = TapePlane::through({1, 2, 3}, {4, 2, 3}, {1, 7, 3});
  ASSERT_TRUE(plane);
  EXPECT_EQ(plane->u(), Vector3d::UnitX());
  EXPECT_EQ(plane->v(), Vector3d::UnitY());
  EXPECT_EQ(plane->normal(), Vector3d::UnitZ());
  EXPECT_DOUBLE_EQ(plane->distance({9, 9, 5}), 2.0);
}

TEST(TapePlane, LiftsWhatItProjects) {
  const auto plane = TapePlane::through({10, -3, 2}, {0, 4, 1}, {5, 5, -7});
  ASSERT_TRUE(plane);
  for (const auto& point : plane->control_points()) {
    EXPECT_LT((plane->lift(plane->project(point)) - point).norm(), 1e-12);
  }
}

TEST(TapePlane, RefusesPointsOnALine) {
  const auto plane = TapePlane::through({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
  ASSERT_FALSE(plane);
  EXPECT_EQ(plane.error().code, ErrorCode::kInvalidInput);
}

/// 0.01 mm, to which people write coordinates, turns the plane by a degree where the third point is
/// half a millimetre beside the line.
TEST(TapePlane, RefusesPointsNearlyOnALine) {
  for (const double beside : {0.01, 0.1, 0.4}) {
    EXPECT_FALSE(TapePlane::through({0, 0, 0}, {50, 0, 0}, {25, beside, 0})) << beside;
    EXPECT_FALSE(TapePlane::through({0, 0, 0}, {25, beside, 0}, {50, 0, 0})) << beside;
  }
  EXPECT_FALSE(TapePlane::through({0, 0, 0}, {50, 0, 0}, {25, 0.499, 0}));
  EXPECT_TRUE(TapePlane::through({0, 0, 0}, {50, 0, 0}, {25, 0.501, 0}));
}

TEST(TapePlane, RefusesEqualPoints) {
  EXPECT_FALSE(TapePlane::through({1, 1, 1}, {1, 1, 1}, {1, 1, 1}));
}

TEST(TapePlane, RefusesWhatIsNoNumberOrAbsurd) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(TapePlane::through({nan, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  EXPECT_FALSE(TapePlane::through({1e30, 0, 0}, {1, 0, 0}, {0, 1, 0}));
}

TEST(TapePlane, TurnsOnItself) {
  const auto plane = TapePlane::through({1, 2, 3}, {4, 2, 3}, {1, 7, 3});
  ASSERT_TRUE(plane);
  const auto turned = plane->turned(std::numbers::pi / 2.0);
  EXPECT_LT((turned.u() - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((turned.v() + Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_EQ(turned.normal(), plane->normal());
  EXPECT_EQ(turned.control_points(), plane->control_points());
}

TEST(TapePlane, MovesWithItsFrame) {
  const auto plane = TapePlane::through({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  ASSERT_TRUE(plane);
  RigidTransform target_from_source = RigidTransform::Identity();
  target_from_source.rotate(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  target_from_source.pretranslate(Vector3d(5, 6, 7));
  const TapePlane moved = plane->transformed(target_from_source);
  const Vector3d point(0.3, -2.0, 4.0);
  EXPECT_NEAR(moved.distance(target_from_source * point), plane->distance(point), 1e-12);
}

}  // namespace
}  // namespace instep
