#include "core/surface/heights/quintic_patch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

/// Over a disc that is about as wide as a patch against a foot.
constexpr double kSphere = 10.0;
const Vector3d kTop(0, 0, kSphere);

std::optional<QuinticPatch> cap_patch(const OrientedPoints& points) {
  return QuinticPatch::fit(points, kTop, Vector3d::UnitZ(), 1.0);
}

/// A polynomial of all five degrees.
double waves(double x, double y) {
  return 0.03 - 0.2 * x + 0.1 * x * y + 0.05 * x * x * x - 0.015 * x * x * y * y +
         0.012 * y * y * y * y * y;
}

OrientedPoints wavy_points(std::size_t count, double unit) {
  OrientedPoints points;
  test::RandomNumbers random(1);
  while (points.size() < count) {
    const double x = random.uniform(-1.0, 1.0);
    const double y = random.uniform(-1.0, 1.0);
    if (x * x + y * y > 1.0) continue;
    points.push_back({unit * Vector3d(x, y, waves(x, y)), Vector3d::UnitZ()});
  }
  return points;
}

TEST(QuinticPatch, IsThePolynomialThatThePointsLieOn) {
  for (const std::size_t count : {65U, 66U, 67U, 400U}) {
    const auto patch =
        QuinticPatch::fit(wavy_points(count, 1.0), Vector3d::Zero(), Vector3d::UnitZ(), 1.0);
    ASSERT_TRUE(patch) << count;
    for (const double x : {-0.6, 0.0, 0.3}) {
      for (const double y : {-0.5, 0.1, 0.7}) {
        const Vector3d place(x, y, waves(x, y) + 0.2);
        EXPECT_NEAR(patch->at(place).value, 0.2, 1e-9);
        const auto value_at = [&](const Vector3d& at) { return patch->at(at).value; };
        const Vector3d slope = test::slope_by_differences(value_at, place, 1e-5);
        EXPECT_NEAR((patch->at(place).gradient - slope).norm(), 0.0, 1e-8);
      }
    }
  }
}

TEST(QuinticPatch, ScalesWithTheUnit) {
  const auto patch =
      QuinticPatch::fit(wavy_points(100, 7.0), Vector3d::Zero(), Vector3d::UnitZ(), 7.0);
  ASSERT_TRUE(patch);
  EXPECT_NEAR(patch->at(7.0 * Vector3d(0.2, 0.3, waves(0.2, 0.3) + 0.1)).value, 0.7, 1e-8);
}

TEST(QuinticPatch, FollowsASphereWhicheverWayItIsSeen) {
  const auto points = test::cap_points(kSphere, 1.0, 120, 0.0, 2);
  for (const Vector3d& outward : {Vector3d(0, 0, 1), Vector3d(0.1, -0.2, 1.0)}) {
    const auto patch = QuinticPatch::fit(points, kTop, outward.normalized(), 1.0);
    ASSERT_TRUE(patch);
    for (const double x : {-0.5, 0.0, 0.6}) {
      const Vector3d on = Vector3d(x, 0.3, std::sqrt(kSphere * kSphere - x * x - 0.09));
      EXPECT_NEAR(patch->at(on).value, 0.0, 1e-7);
      EXPECT_GT(patch->at(1.001 * on).value, 0.0);
      EXPECT_NEAR(patch->at(on).gradient.normalized().dot(on.normalized()), 1.0, 1e-9);
    }
  }
}

TEST(QuinticPatch, TellsByHowMuchThePointsAreOff) {
  constexpr double kSigma = 1e-5;
  const auto patch = cap_patch(test::cap_points(kSphere, 1.0, 400, kSigma, 3));
  ASSERT_TRUE(patch);
  EXPECT_NEAR(std::sqrt(patch->variance()), kSigma, 0.1 * kSigma);
}

TEST(QuinticPatch, IsNoneOfPointsWithNoise) {
  EXPECT_FALSE(cap_patch(test::cap_points(kSphere, 1.0, 120, 1e-4, 4)));
}

TEST(QuinticPatch, IsNoneOverACrease) {
  auto points = test::disc_points(kTop, Vector3d::UnitZ(), 1.0, 120, 0.0, 5);
  for (auto& point : points) point.position.z() -= 0.02 * std::max(point.position.x() - 0.5, 0.0);
  EXPECT_FALSE(cap_patch(points));
}

TEST(QuinticPatch, IsNoneBesideItsPoints) {
  auto points = test::cap_points(kSphere, 1.0, 240, 0.0, 6);
  std::erase_if(points, [](const OrientedPoint& point) { return point.position.x() < 0.1; });
  EXPECT_FALSE(cap_patch(points));
}

TEST(QuinticPatch, IsNoneOfTooFewPoints) {
  EXPECT_FALSE(cap_patch(test::cap_points(kSphere, 1.0, 21, 0.0, 7)));
}

/// It told the fifth power across them alone, and the polynomial passed through it.
TEST(QuinticPatch, IsNotBentByAStrayBesideRows) {
  for (const double stray : {-0.5, 0.3}) {
    OrientedPoints points{{Vector3d(0.01, 0.998, stray), Vector3d::UnitZ()}};
    for (int row = 0; row < 5; ++row) {
      const double y = -0.72 + 0.344 * row;
      for (double x = -0.95 - 0.01 * row; x < 1.0; x += 0.092) {
        if (x * x + y * y < 1.0) points.push_back({Vector3d(x, y, 0.0), Vector3d::UnitZ()});
      }
    }
    const auto patch = QuinticPatch::fit(points, Vector3d::Zero(), Vector3d::UnitZ(), 1.0);
    EXPECT_FALSE(patch) << "off by " << patch->at(Vector3d::Zero()).value;
  }
}

}  // namespace
}  // namespace instep
