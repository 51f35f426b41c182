// Of several bodies that a tape plane cuts, the one that its control points lie on is meant.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/girth/contour/control_points.h"
#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSmall = 25.0;
constexpr double kLarge = 35.0;
constexpr double kHeight = 1.3;

/// A round body at the origin, and a larger one beside it.
PointCloud two_bodies(double apart_mm, double noise_mm) {
  PointCloud cloud =
      test::random_points(test::elliptic_cylinder(kSmall, kSmall), 4000, -30, 30, 0.0, 1);
  const Vector3d beside(kSmall + apart_mm + kLarge, 0.0, 0.0);
  for (const auto& point :
       test::random_points(test::elliptic_cylinder(kLarge, kLarge), 6000, -30, 30, 0.0, 2)
           .positions) {
    cloud.positions.push_back(point + beside);
  }
  test::RandomNumbers random(3);
  for (auto& point : cloud.positions) {
    point += noise_mm * Vector3d(random.normal(), random.normal(), random.normal());
  }
  return cloud;
}

TapePlane plane_by(const Vector2d& middle, double radius, const std::array<double, 3>& angles) {
  std::array<Vector3d, 3> points;
  for (std::size_t i = 0; i < 3; ++i) {
    points[i] = Vector3d(middle.x() + radius * std::cos(angles[i]),
                         middle.y() + radius * std::sin(angles[i]), kHeight);
  }
  return *TapePlane::through(points[0], points[1], points[2]);
}

TapePlane by_small() {
  return plane_by({0.0, 0.0}, kSmall, {0.4, 2.5, 4.4});
}

TapePlane by_large(double apart_mm) {
  return plane_by({kSmall + apart_mm + kLarge, 0.0}, kLarge, {0.4, 2.5, 4.4});
}

TEST(PointedBodyGirth, IsOfTheOneThatTheControlPointsLieOn) {
  for (const double apart_mm : {3.0, 8.0, 40.0}) {
    for (const double noise_mm : {0.0, 0.3}) {
      const auto cloud = two_bodies(apart_mm, noise_mm);
      const auto small = girth_by_rbf(cloud, by_small());
      // Noisy skin that runs so near beside is not told from its own; the larger body is no answer.
      if (!small && apart_mm < 5.0 && noise_mm > 0.0) continue;
      ASSERT_TRUE(small) << small.error().line();
      EXPECT_NEAR(small->contact_mm, 2.0 * M_PI * kSmall, 0.02 + *small->contact_u95_mm);
      EXPECT_FALSE(small->warnings.empty());
      const auto large = girth_by_rbf(cloud, by_large(apart_mm));
      ASSERT_TRUE(large) << large.error().line();
      EXPECT_NEAR(large->contact_mm, 2.0 * M_PI * kLarge, 0.02 + *large->contact_u95_mm);
    }
  }
}

/// What lies beside it shares its noise and its normals, and does not close.
TEST(PointedBodyGirth, IsToldBesideALargerOneThatIsOpen) {
  PointCloud cloud = two_bodies(20.0, 0.1);
  std::erase_if(cloud.positions, [](const Vector3d& point) { return point.x() > 95.0; });
  const auto girth = girth_by_rbf(cloud, by_small());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, 2.0 * M_PI * kSmall, 0.02 + *girth->contact_u95_mm);
}

TEST(PointedBodyGirth, IsOfTheLargestWhereTheControlPointsLieOnNone) {
  const auto cloud = two_bodies(8.0, 0.0);
  const auto girth = girth_by_rbf(cloud, plane_by({0.0, 0.0}, 0.5 * kSmall, {0.4, 2.5, 4.4}));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, 2.0 * M_PI * kLarge, 0.02);
}

TEST(PointedBodyGirth, IsThatOfTheMeshToo) {
  const auto cloud = two_bodies(8.0, 0.0);
  const auto girth = girth_by_mesh(cloud, by_small());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, 2.0 * M_PI * kSmall, 0.3);
}

TEST(PointedBodyGirth, GoesByControlPointsThatLieAFiftiethBeside) {
  const std::vector<Vector2d> square{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  const auto plane = [](double off) {
    return *TapePlane::through({0, 50, 0}, {50, off, 0}, {100, 50, 0});
  };
  const auto turned = [&](const TapePlane& to) {
    std::vector<Vector2d> corners;
    for (const auto& corner : square) {
      corners.push_back(to.project(Vector3d(corner.x(), corner.y(), 0)));
    }
    return corners;
  };
  EXPECT_TRUE(goes_by_control_points(turned(plane(0)), plane(0)));
  EXPECT_TRUE(goes_by_control_points(turned(plane(7.9)), plane(7.9)));
  EXPECT_FALSE(goes_by_control_points(turned(plane(8.1)), plane(8.1)));
  EXPECT_FALSE(goes_by_control_points({}, plane(0)));
}

}  // namespace
}  // namespace instep
