#include "core/fusion/sole/close_sole.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRadius = 50.0;
constexpr double kHeight = 60.0;

void add(PointCloud& cloud, const Vector3d& point, const Vector3d& normal) {
  cloud.positions.push_back(point);
  cloud.normals.push_back(normal);
  cloud.sigma_mm.push_back(0.2);
  cloud.view_directions.push_back(normal);
}

/// An upright round wall whose bottom edge is rounded, seen down to where its normal points
/// `seen_deg` below the horizon; open below.
PointCloud rounded_wall(double rounding, double seen_deg) {
  PointCloud cloud;
  for (double turn = 0; turn < 2 * std::numbers::pi; turn += 0.015) {
    const Vector3d out(std::cos(turn), std::sin(turn), 0);
    for (double z = rounding; z <= kHeight; z += 0.8) {
      add(cloud, kRadius * out + z * Vector3d::UnitZ(), out);
    }
    for (double degree = 0; degree <= seen_deg; degree += 3) {
      const double phi = degree * std::numbers::pi / 180;
      const Vector3d normal = std::cos(phi) * out - std::sin(phi) * Vector3d::UnitZ();
      add(cloud, (kRadius - rounding) * out + rounding * Vector3d::UnitZ() + rounding * normal,
          normal);
    }
  }
  return cloud;
}

/// Length of a stretched tape in the plane y = 0.
double stretched_girth(const PointCloud& cloud) {
  std::vector<Vector2d> section;
  for (const auto& point : cloud.positions) {
    if (std::abs(point.y()) < 1.5) section.emplace_back(point.x(), point.z());
  }
  return perimeter(convex_hull(section));
}

TEST(CloseSole, LeavesTheStretchedGirthOfARoundedBottomTrue) {
  for (const double rounding : {4.0, 8.0, 12.0}) {
    for (const double seen_deg : {30.0, 45.0, 60.0}) {
      auto cloud = rounded_wall(rounding, seen_deg);
      const auto closure = close_sole(cloud, 0.0);
      EXPECT_GT(closure.points_added, 500U);
      const double truth = 2 * kHeight + 4 * kRadius - rounding * (4 - std::numbers::pi);
      EXPECT_NEAR(stretched_girth(cloud), truth, 1.5) << rounding << " " << seen_deg;
    }
  }
}

TEST(CloseSole, MarksItsPointsAndRestsThemOnThePlatform) {
  auto cloud = rounded_wall(8, 45);
  for (auto& point : cloud.positions) point.z() += 33.0;
  const std::size_t seen = cloud.size();
  const auto closure = close_sole(cloud, 33.0);
  ASSERT_EQ(cloud.size(), seen + closure.points_added);
  EXPECT_TRUE(check_cloud(cloud));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ(cloud.was_seen(i), i < seen);
    if (i < seen) continue;
    const double reach = cloud.positions[i].head<2>().norm();
    EXPECT_LT(reach, kRadius);
    EXPECT_GE(cloud.positions[i].z(), 33.0);
    EXPECT_LT(cloud.normals[i].z(), 0.0);
    if (reach > kRadius - 8 - 10) continue;
    EXPECT_EQ(cloud.positions[i].z(), 33.0);
    EXPECT_EQ(cloud.normals[i], -Vector3d::UnitZ());
  }
}

TEST(CloseSole, LeavesNoGapInAWallWhoseFootWasHidden) {
  constexpr double kHidden = 28.0;
  PointCloud cloud;
  const PointCloud whole = rounded_wall(8, 45);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const bool is_hidden = whole.positions[i].x() > 0.0 && whole.positions[i].z() < kHidden;
    if (!is_hidden) add(cloud, whole.positions[i], whole.normals[i]);
  }
  close_sole(cloud, 0.0);
  for (const double turn : {-0.9, -0.3, 0.0, 0.4, 1.0}) {
    const Vector3d out(std::cos(turn), std::sin(turn), 0.0);
    for (double z = 9.0; z < kHidden; z += 1.0) {
      const Vector3d place = kRadius * out + z * Vector3d::UnitZ();
      double nearest = 1e9;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const double distance = (cloud.positions[i] - place).norm();
        if (distance >= nearest) continue;
        nearest = distance;
        EXPECT_TRUE(distance > 3.0 || cloud.normals[i].dot(out) > 0.9) << turn << " " << z;
      }
      EXPECT_LT(nearest, 2.6) << turn << " " << z;
    }
  }
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.was_seen(i) || cloud.positions[i].z() < 12.0) continue;
    EXPECT_NEAR(cloud.positions[i].head<2>().norm(), kRadius, 0.5);
  }
}

TEST(CloseSole, GoesOnWithTheRoundingThatWasSeen) {
  for (const double rounding : {6.0, 12.0, 20.0}) {
    auto cloud = rounded_wall(rounding, 45);
    close_sole(cloud, 0.0);
    int on_rounding = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.was_seen(i)) continue;
      const double beyond = cloud.positions[i].head<2>().norm() - (kRadius - rounding);
      const double height =
          beyond > 0 ? rounding - std::sqrt(rounding * rounding - beyond * beyond) : 0.0;
      EXPECT_NEAR(cloud.positions[i].z(), height, 0.7) << rounding << " " << beyond;
      on_rounding += height > 0.5 ? 1 : 0;
    }
    EXPECT_GT(on_rounding, 50);
  }
}

TEST(CloseSole, AddsNothingWhereTheSoleWasSeen) {
  auto cloud = rounded_wall(8, 85);
  for (double x = -kRadius; x < kRadius; x += 1) {
    for (double y = -kRadius; y < kRadius; y += 1) {
      if (Vector2d(x, y).norm() < kRadius - 8) add(cloud, {x, y, 0}, -Vector3d::UnitZ());
    }
  }
  const auto closure = close_sole(cloud, 0.0);
  EXPECT_EQ(closure.points_added, 0U);
}

TEST(CloseSole, KeepsOutOfTheHollowUnderALeaningWall) {
  // On the side of +x the wall ends 15 mm above the platform and leans in by 30 degrees below 35.
  PointCloud arched;
  const PointCloud cloud = rounded_wall(6, 45);
  const double slope = std::tan(std::numbers::pi / 6);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Vector3d point = cloud.positions[i];
    if (point.x() < 20) {
      add(arched, point, cloud.normals[i]);
    } else if (point.z() > 35) {
      add(arched, point, cloud.normals[i]);
    } else if (point.z() > 15) {
      const Vector3d out = cloud.normals[i];
      point -= (35 - point.z()) * slope * out;
      add(arched, point, (out - slope * Vector3d::UnitZ()).normalized());
    }
  }
  close_sole(arched, 0.0);
  int in_hollow = 0;
  for (std::size_t i = 0; i < arched.size(); ++i) {
    if (arched.was_seen(i) || std::abs(arched.positions[i].y()) > 15) continue;
    const bool rests = arched.positions[i].z() < 1.0;
    EXPECT_FALSE(rests && arched.positions[i].x() > kRadius - 20);
    in_hollow += arched.positions[i].z() > 3.0 ? 1 : 0;
  }
  EXPECT_GT(in_hollow, 20);
}

TEST(CloseSole, SpansAnArchWithoutTakingTheContactBesideIt) {
  // A long foot whose wall stands at y = 0 and bends inward below in an arc: in the middle with a
  // radius of 60 mm, elsewhere of 6 mm, seen down to 45 degrees below the horizon.
  PointCloud cloud;
  const auto add_wall = [&](double x, double radius, double step_deg) {
    const Vector3d centre(x, radius, radius);
    for (double degree = 0; degree <= 45; degree += step_deg) {
      const double phi = degree * std::numbers::pi / 180;
      const Vector3d normal(0, -std::cos(phi), -std::sin(phi));
      add(cloud, centre + radius * normal, normal);
    }
    for (double z = radius; z < kHeight; z += 1) add(cloud, {x, 0, z}, -Vector3d::UnitY());
  };
  for (double x = -100; x <= 100; x += 1) {
    std::abs(x) < 25 ? add_wall(x, 60, 1) : add_wall(x, 6, 5);
    for (double z = 0; z < kHeight; z += 1) add(cloud, {x, 100, z}, Vector3d::UnitY());
  }
  for (double y = 0; y <= 100; y += 1) {
    for (double z = 0; z < kHeight; z += 1) {
      add(cloud, {-100, y, z}, -Vector3d::UnitX());
      add(cloud, {100, y, z}, Vector3d::UnitX());
    }
  }
  const auto closure = close_sole(cloud, 0.0);
  // The arc's own contact, and what the skin may take to settle.
  EXPECT_GT(closure.widest_inset_mm, 60 * std::cos(std::numbers::pi / 4) - 3.0);
  EXPECT_LT(closure.widest_inset_mm, 65.0);
  double under_arch = 100.0;
  double beside = 100.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.was_seen(i)) continue;
    const auto& point = cloud.positions[i];
    if (std::abs(point.x()) < 10 && point.y() < 60) {
      EXPECT_NEAR(point.z(), 60 - std::sqrt(3600 - std::pow(60 - point.y(), 2)), 0.6);
    }
    if (point.z() > 0.1) continue;
    if (std::abs(point.x()) < 10) under_arch = std::min(under_arch, point.y());
    if (std::abs(point.x()) > 50 && std::abs(point.x()) < 80) beside = std::min(beside, point.y());
  }
  EXPECT_NEAR(under_arch, 60.0, 4.0);
  EXPECT_LT(beside, 10.0);
}

TEST(CloseSole, BearsNoPointsAndPointsWithoutNormals) {
  PointCloud none;
  EXPECT_EQ(close_sole(none, 0.0).points_added, 0U);
  PointCloud bare;
  bare.positions = {{0, 0, 1}, {1, 0, 1}};
  EXPECT_EQ(close_sole(bare, 0.0).points_added, 0U);
  PointCloud single;
  add(single, {1e5, -1e5, 3}, Vector3d::UnitX());
  EXPECT_LT(close_sole(single, 0.0).points_added, 50U);
}

}  // namespace
}  // namespace instep
