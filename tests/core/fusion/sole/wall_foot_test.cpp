#include "core/fusion/sole/wall_foot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStraight = 0.0;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

WallFoot wall(double height, double dip_deg, double bend, double most_inset = 500.0) {
  return {{0, 0}, {1, 0}, {height, std::sin(radians(dip_deg)), bend, most_inset}};
}

/// Height at `x` of the lower hull of the circle that continues the wall and of its contact: what a
/// tape would touch.
double taut_height(double height, double dip_deg, double radius, double contact, double x) {
  const double dip = radians(dip_deg);
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

double slope_at(const WallFoot& foot, double inward) {
  constexpr double kStep = 0.3;
  return (foot.skin_height(inward) - foot.skin_height(inward + kStep)) / kStep;
}

TEST(WallFoot, LeavesTheWallInItsOwnDirectionAndSettlesLevel) {
  for (const double height : {3.0, 6.0, 12.0}) {
    for (const double dip_deg : {30.0, 45.0, 60.0}) {
      for (const double bend : {0.05, 0.005, kStraight}) {
        const WallFoot foot = wall(height, dip_deg, bend);
        EXPECT_NEAR(foot.skin_height(0.0), height, 1e-9);
        EXPECT_NEAR(std::atan(1.0 / slope_at(foot, 0.0)), radians(dip_deg), radians(5));
        // Of the arc from here that touches the platform, half a millimetre before it does.
        const double slope = 0.5 * (1.0 - std::sin(radians(dip_deg))) / height;
        EXPECT_LT(slope_at(foot, foot.contact() - 0.5), slope) << height << " " << dip_deg;
      }
    }
  }
}

TEST(WallFoot, GoesOnInTheBendOfTheWall) {
  // Steep enough to be felt at once, and not so that it must turn up: the circle of the wall, of
  // which the first two millimetres are taken, is the truth.
  for (const double radius : {18.0, 25.0, 32.0}) {
    const double dip = radians(40);
    const double height = 0.95 * radius * (1 - std::sin(dip));
    const WallFoot foot = wall(height, 40, 1.6 / radius);
    const double bent = 1.0 / 1.6 * radius;
    const Vector2d centre(bent * std::cos(dip), height + bent * std::sin(dip));
    const double truth = centre.y() - std::sqrt(bent * bent - std::pow(centre.x() - 2.0, 2));
    EXPECT_NEAR(foot.skin_height(2.0), truth, 0.08) << radius;
  }
}

TEST(WallFoot, GoesOnInAnArcToThePlatformWhereItEndsLowAndStraight) {
  for (const double height : {4.0, 7.0}) {
    for (const double dip_deg : {27.0, 40.0, 55.0}) {
      const double dip = radians(dip_deg);
      const double radius = height / (1 - std::sin(dip));
      const WallFoot foot = wall(height, dip_deg, kStraight);
      for (double x = 0; x < radius * std::cos(dip); x += 0.5) {
        const double beyond = radius * std::cos(dip) - x;
        const double truth = radius - std::sqrt(radius * radius - beyond * beyond);
        EXPECT_NEAR(foot.skin_height(x), truth, 0.03) << height << " " << dip_deg << " " << x;
      }
    }
  }
}

TEST(WallFoot, HangsInAnArcBelowTheUsualEdgeHoweverHighThatIs) {
  const double dip = radians(40.0);
  for (const double edge : {8.0, 12.0, 20.0}) {
    WallSettings settings;
    settings.usual_edge_mm = edge;
    for (const double height : {4.0, 7.0}) {
      const WallFoot foot({0, 0}, {1, 0}, {height, std::sin(dip), kStraight, 500.0}, settings);
      const double contact = height / (1 - std::sin(dip)) * std::cos(dip);
      EXPECT_NEAR(foot.contact(), contact, 0.01 * contact) << edge << " " << height;
    }
  }
}

TEST(WallFoot, LeansInAtOnceWhereItEndsBelowTheUsualEdge) {
  const WallFoot upright = wall(5.0, 5.0, kStraight);
  const WallFoot leaning = wall(5.0, 26.0, kStraight);
  for (double x = 0.5; x < leaning.contact(); x += 0.5) {
    EXPECT_NEAR(upright.skin_height(x), leaning.skin_height(x), 0.1) << x;
  }
}

TEST(WallFoot, ComesDownInASlopeFromHighBesideAnArch) {
  const double contact_of_arc = 20.0 / (1 - std::sin(radians(35))) * std::cos(radians(35));
  EXPECT_GT(wall(20.0, 35.0, 0.01).contact(), 1.3 * contact_of_arc);
}

TEST(WallFoot, LaysATautTapeOverAnArch) {
  for (const double height : {15.0, 25.0}) {
    for (const double radius : {8.0, 12.0, 20.0}) {
      for (const double most_inset : {30.0, 45.0}) {
        const double dip_deg = 45.0;
        const WallFoot foot = wall(height, dip_deg, 1.0 / radius, most_inset);
        ASSERT_NEAR(foot.contact(), most_inset, 1e-9) << height << " " << radius;
        for (double x = 0; x < most_inset; x += 0.7) {
          EXPECT_NEAR(foot.skin_height(x), taut_height(height, dip_deg, radius, most_inset, x),
                      0.03)
              << height << " " << radius << " " << x;
        }
      }
    }
  }
}

TEST(WallFoot, NeverRisesInwardAndEndsOnThePlatform) {
  for (double height = 0.0; height <= 35.0; height += 1.0) {
    for (double dip_deg = -20.0; dip_deg < 90.0; dip_deg += 5.0) {
      for (const double bend : {2.0, 0.2, 0.02, 1e-4, kStraight}) {
        for (const double most_inset : {0.0, 20.0, 60.0}) {
          const WallFoot foot = wall(height, dip_deg, bend, most_inset);
          EXPECT_GE(foot.contact(), 3.0);
          EXPECT_LE(foot.contact(), std::max(3.0, most_inset) + 1e-9);
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
}

TEST(WallFoot, GoesOnUprightToTheUsualEdgeWhereItsFootWasHidden) {
  const WallFoot foot = wall(25.0, 0.0, kStraight);
  EXPECT_LE(foot.skin_height(0.01), WallSettings{}.usual_edge_mm);
  EXPECT_GT(foot.contact(), WallSettings{}.usual_edge_mm);
  EXPECT_LT(foot.contact(), 3.0 * WallSettings{}.usual_edge_mm);
}

/// The circle of the wall is the truth: outwards first, and back.
TEST(WallFoot, GoesOnRoundItsWidestPlaceWhereItWasLostAboveThat) {
  for (const double height : {20.0, 30.0}) {
    for (const double dip_deg : {-20.0, -10.0, 0.0}) {
      const double radius = 30.0;
      const WallFoot foot = wall(height, dip_deg, 1.0 / radius);
      const double dip = radians(dip_deg);
      const Vector2d centre(radius * std::cos(dip), height + radius * std::sin(dip));
      const auto places = foot.hidden_wall(1.0);
      ASSERT_GT(places.size(), 10U);
      double before = height;
      for (const auto& place : places) {
        const Vector2d from_centre = Vector2d(place.inward, place.height) - centre;
        EXPECT_NEAR(from_centre.norm(), radius, 0.1) << height << " " << dip_deg;
        EXPECT_NEAR(place.sine_of_dip, -from_centre.y() / radius, 0.05);
        EXPECT_LT(place.height, before);
        EXPECT_NEAR(before - place.height, 1.0, 0.12);
        before = place.height;
      }
      // It ends where a sole's edge begins, by its height or by how it leans.
      const double leaning = centre.y() - 0.45 * radius;
      EXPECT_NEAR(before, std::max(leaning, WallSettings{}.usual_edge_mm), 1.0);
      const double back = 2.0 * centre.y() - height;  // where it is below its end again
      if (back < before) continue;
      EXPECT_NEAR(foot.skin_height(0.0), back, 0.2) << height << " " << dip_deg;
    }
  }
}

TEST(WallFoot, BulgesByTwoMillimetresAtTheMost) {
  double most = 0.0;
  for (const auto& place : wall(30.0, -40.0, 0.005).hidden_wall(1.0)) {
    most = std::max(most, -place.inward);
  }
  EXPECT_NEAR(most, 2.0, 1e-9);
}

TEST(WallFoot, HasNoHiddenWallBelowAnEndThatWasSeenSoFar) {
  EXPECT_TRUE(wall(7.0, 0.0, 0.03).hidden_wall(1.0).empty());
  EXPECT_TRUE(wall(20.0, 30.0, 0.03).hidden_wall(1.0).empty());
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

TEST(FindWallFeet, FollowsARoundingAllRound) {
  for (const double rounding : {8.0, 20.0}) {
    auto cloud = rounded_wall(rounding);
    for (auto& point : cloud.positions) point.z() += 40.0;
    const auto feet = find_wall_feet(cloud, 40.0);
    EXPECT_GT(feet.size(), 30U);
    for (const auto& foot : feet) {
      EXPECT_GT(foot.out().dot(foot.place().normalized()), 0.99);
      // What leans in less than a sole's edge does, so near to the platform, is taken to lean more.
      const double dip = std::asin(1.0 - std::min(1.0, foot.skin_height(0.0) / rounding));
      const double more = std::max(0.0, std::asin(0.45) - dip);
      for (double x = 0; x < rounding; x += 0.5) {
        const double beyond = foot.place().norm() - x - (50 - rounding);
        const double height = foot.skin_height(x);
        const double off = beyond > 0 ? std::hypot(beyond, rounding - height) - rounding : height;
        EXPECT_NEAR(off, 0.0, 0.07 * rounding + more * x) << rounding << " " << x;
      }
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
  const auto feet = find_wall_feet(cloud, 0.0);
  EXPECT_GT(feet.size(), 10U);
  for (const auto& foot : feet) {
    if (std::abs(foot.place().y()) > 50) continue;
    EXPECT_LT(foot.place().x(), 20 + 8 * std::tan(lean));
    EXPECT_LT(foot.skin_height(0.0), 8.0);
  }
}

}  // namespace
}  // namespace instep
