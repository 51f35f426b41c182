#include "core/fusion/wall_foot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStraight = std::numeric_limits<double>::infinity();

WallFoot wall(double height, double dip_deg, double bend_radius) {
  return {{0, 0}, {1, 0}, height, std::sin(dip_deg * std::numbers::pi / 180), bend_radius, {}};
}

/// Height at `x` of the lower hull of the circle that continues the wall and of its contact: what a
/// tape would touch.
double taut_height(double height, double dip_deg, double radius, double contact, double x) {
  const double dip = dip_deg * std::numbers::pi / 180;
  const Vector2d centre(radius * std::cos(dip), height + radius * std::sin(dip));
  std::vector<Vector2d> points = {{contact, 0}, {contact, 1000}, {0, 1000}};
  for (double angle = dip; angle <= std::numbers::pi / 2; angle += 1e-4) {
    points.push_back(centre - radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  const auto hull = convex_hull(points);
  double lowest = 1e9;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d& a = hull[i];
    const Vector2d& b = hull[(i + 1) % hull.size()];
    if (x < std::min(a.x(), b.x()) || x > std::max(a.x(), b.x()) || a.x() == b.x()) continue;
    lowest = std::min(lowest, a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x()));
  }
  return lowest;
}

TEST(WallFoot, RoundsAnEdgeInTheArcThatTouchesThePlatform) {
  for (const double radius : {6.0, 10.0, 15.0}) {
    for (const double dip_deg : {30.0, 45.0, 60.0}) {
      const double dip = dip_deg * std::numbers::pi / 180;
      const double contact = radius * std::cos(dip);
      if (contact < 3.0) continue;
      for (const double bend : {radius * 1.001, 200.0, kStraight}) {
        const WallFoot foot = wall(radius * (1 - std::sin(dip)), dip_deg, bend);
        EXPECT_NEAR(foot.contact(), contact, 1e-6);
        for (double x = 0; x < contact; x += 0.5) {
          const double truth = radius - std::sqrt(radius * radius - std::pow(contact - x, 2));
          EXPECT_NEAR(foot.skin_height(x), truth, 1e-3) << radius << " " << dip_deg << " " << x;
        }
      }
    }
  }
}

TEST(WallFoot, LaysATautTapeOverAnArch) {
  for (const double height : {8.0, 15.0, 25.0}) {
    for (const double bend : {4.0, 12.0, 25.0}) {
      const double dip_deg = 45.0;
      const WallFoot foot = wall(height, dip_deg, bend);
      for (double x = 0; x < foot.contact(); x += 0.7) {
        EXPECT_NEAR(foot.skin_height(x), taut_height(height, dip_deg, bend, foot.contact(), x),
                    0.01)
            << height << " " << bend << " " << x;
      }
    }
  }
}

TEST(WallFoot, NeverRisesInwardAndEndsOnThePlatform) {
  for (double height = 0.0; height <= 35.0; height += 1.0) {
    for (double dip_deg = -20.0; dip_deg < 90.0; dip_deg += 5.0) {
      for (const double bend : {0.5, 5.0, 50.0, 1e4, kStraight}) {
        const WallFoot foot = wall(height, dip_deg, bend);
        EXPECT_GE(foot.contact(), WallSettings{}.least_inset_mm);
        EXPECT_LE(foot.contact(), WallSettings{}.most_inset_mm);
        double before = height + 1e-6;
        for (double x = 0.0; x <= foot.contact() + 1.0; x += 0.25) {
          const double own = foot.skin_height(x);
          ASSERT_GE(own, 0.0);
          ASSERT_LE(own, before + 1e-9) << height << " " << dip_deg << " " << bend << " " << x;
          before = own;
        }
        EXPECT_EQ(foot.skin_height(foot.contact()), 0.0);
      }
    }
  }
}

TEST(WallFoot, TakesTheUsualRadiusBelowAnUprightWallWhoseFootWasHidden) {
  const WallFoot foot = wall(25.0, 0.0, kStraight);
  EXPECT_NEAR(foot.contact(), WallSettings{}.usual_radius_mm, 1e-6);
}

/// A round wall of 50 mm radius whose bottom edge is rounded, seen down to 45 degrees.
PointCloud rounded_wall(double rounding) {
  PointCloud cloud;
  const auto add = [&](const Vector3d& point, const Vector3d& normal) {
    cloud.positions.push_back(point);
    cloud.normals.push_back(normal);
  };
  for (double turn = 0; turn < 2 * std::numbers::pi; turn += 0.02) {
    const Vector3d out(std::cos(turn), std::sin(turn), 0);
    for (double z = rounding; z <= 60; z += 1) add(50 * out + z * Vector3d::UnitZ(), out);
    for (double phi = 0; phi < std::numbers::pi / 4; phi += 1.0 / rounding) {
      const Vector3d normal = std::cos(phi) * out - std::sin(phi) * Vector3d::UnitZ();
      add((50 - rounding) * out + rounding * (Vector3d::UnitZ() + normal), normal);
    }
  }
  return cloud;
}

TEST(FindWallFeet, FindsTheContactOfARoundingAllRound) {
  for (const double rounding : {8.0, 20.0}) {
    auto cloud = rounded_wall(rounding);
    for (auto& point : cloud.positions) point.z() += 40.0;
    const auto feet = find_wall_feet(cloud, 40.0, {});
    EXPECT_GT(feet.size(), 30U);
    for (const auto& foot : feet) {
      EXPECT_GT(foot.out().dot(foot.place().normalized()), 0.99);
      EXPECT_NEAR(foot.place().norm() - foot.contact(), 50 - rounding, 0.15 * rounding);
    }
  }
}

TEST(FindWallFeet, TakesNeitherTheBackOfAFootNorALeaningWallHigherUpForOne) {
  // A wall that leans in by 40 degrees from z = 30 down to 6, and a back above it.
  PointCloud cloud;
  const double lean = 40 * std::numbers::pi / 180;
  for (double y = -60; y <= 60; y += 1) {
    for (double z = 6; z <= 30; z += 0.8) {
      cloud.positions.emplace_back(20 + z * std::tan(lean), y, z);
      cloud.normals.emplace_back(std::cos(lean), 0, -std::sin(lean));
    }
    for (double x = 0; x <= 45; x += 1) {
      cloud.positions.emplace_back(x, y, 34 - 0.1 * x);
      cloud.normals.push_back(Vector3d(0.1, 0, 1).normalized());
    }
  }
  const auto feet = find_wall_feet(cloud, 0.0, {});
  EXPECT_GT(feet.size(), 10U);
  for (const auto& foot : feet) {
    if (std::abs(foot.place().y()) > 50) continue;
    EXPECT_LT(foot.place().x(), 20 + 8 * std::tan(lean));
    EXPECT_LT(foot.skin_height(0.0), 8.0);
  }
}

}  // namespace
}  // namespace instep
