#include "core/fusion/sole/wall_end.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kReach = 10.0;
constexpr double kMostZ = 15.0;
constexpr double kStepMm = 0.7;

/// Part of the skin of a cylinder that lies along y: from `from` to `to`, radians over the level.
struct Roll {
  double radius = 0.0;
  double from = 0.0;
  double to = 0.0;
  bool is_hollow = false;  ///< seen from inside
};

/// With the axis `axis_z` high, over x = 0, and 60 mm long.
PointCloud skin(const Roll& roll, double axis_z) {
  PointCloud cloud;
  for (double along = -30.0; along <= 30.0; along += kStepMm) {
    for (double angle = roll.from; angle <= roll.to; angle += kStepMm / roll.radius) {
      const Vector3d out(-std::cos(angle), 0.0, std::sin(angle));
      cloud.positions.push_back(roll.radius * out + Vector3d(0.0, along, axis_z));
      cloud.normals.push_back(roll.is_hollow ? Vector3d(-out) : out);
    }
  }
  return cloud;
}

void add(PointCloud& cloud, const PointCloud& other) {
  cloud.positions.insert(cloud.positions.end(), other.positions.begin(), other.positions.end());
  cloud.normals.insert(cloud.normals.end(), other.normals.begin(), other.normals.end());
}

/// The ends that are not at the two ends of the roll, where half of the wall is missing.
std::vector<WallEnd> inner_ends(const PointCloud& cloud) {
  auto ends = find_wall_ends(cloud, kMostZ, kReach);
  std::erase_if(ends, [](const WallEnd& end) { return std::abs(end.position.y()) > 20.0; });
  return ends;
}

TEST(WallEnd, OfARoundWallLiesOnItWithItsNormalAndItsBend) {
  for (const double radius : {12.0, 20.0, 60.0}) {
    for (const bool is_hollow : {false, true}) {
      for (const double from : {-0.4, -0.1}) {
        // Its lowest point is 5 mm high.
        const double axis_z = 5.0 - radius * std::sin(from);
        const auto ends = inner_ends(skin({radius, from, from + 1.2, is_hollow}, axis_z));
        ASSERT_GE(ends.size(), 5U);
        for (const auto& end : ends) {
          const Vector3d arm = end.position - Vector3d(0.0, end.position.y(), axis_z);
          const Vector3d out = is_hollow ? Vector3d(-arm.normalized()) : arm.normalized();
          EXPECT_NEAR(arm.norm(), radius, 0.05);
          EXPECT_NEAR(end.position.z(), 5.0, 1.5) << "among the lowest points";
          EXPECT_NEAR(end.normal.norm(), 1.0, 1e-12);
          EXPECT_GT(end.normal.dot(out), std::cos(0.03));
          EXPECT_NEAR(end.bend * radius, is_hollow ? -1.0 : 1.0, 0.1) << radius << " " << from;
        }
      }
    }
  }
}

TEST(WallEnd, IsNoneAboveTheHeightAskedFor) {
  const Roll wall{20.0, -0.6, 0.6, false};
  EXPECT_FALSE(find_wall_ends(skin(wall, 25.0), 15.0, kReach).empty());
  EXPECT_TRUE(find_wall_ends(skin(wall, 28.0), 15.0, kReach).empty()) << "it ends 16.7 mm high";
  EXPECT_TRUE(find_wall_ends({}, 15.0, kReach).empty());
}

/// The same roll, seen from above only, is the back of a foot.
TEST(WallEnd, IsNoneOnTheBackOfAFoot) {
  EXPECT_TRUE(
      find_wall_ends(skin({20.0, 0.8, std::numbers::pi - 0.8, false}, -8.0), 15.0, kReach).empty());
}

/// A gap in the wall, as a strap leaves, parts it: its upper part ends there, but not in the air.
TEST(WallEnd, IsNoneWhereTheSkinGoesOnBelow) {
  PointCloud wall = skin({60.0, 0.10, 0.30, false}, 5.0);
  ASSERT_FALSE(inner_ends(wall).empty());
  add(wall, skin({60.0, -0.05, 0.02, false}, 5.0));
  for (const auto& end : inner_ends(wall)) {
    EXPECT_LT(end.position.z(), 5.0) << "the lower part's alone";
  }
}

/// Points of one height are common: depth comes in steps. Two are the lowest of one place, and only
/// one of them lies steeply below the wall beside it.
TEST(WallEnd, DoesNotDependOnTheOrderOfPoints) {
  PointCloud cloud = skin({20.0, -0.3, 0.6, false}, 11.0);
  for (auto& position : cloud.positions) position.z() = 0.5 * std::round(position.z() / 0.5);
  for (int i = 0; i < 12; ++i) {
    for (const double x : {-21.1, -26.9}) {
      cloud.positions.emplace_back(x, 4.0 * i - 22.0, 0.0);
      cloud.normals.emplace_back(-1.0, 0.0, 0.0);
    }
  }
  const auto ends = find_wall_ends(cloud, kMostZ, kReach);
  std::reverse(cloud.positions.begin(), cloud.positions.end());
  std::reverse(cloud.normals.begin(), cloud.normals.end());
  const auto again = find_wall_ends(cloud, kMostZ, kReach);
  ASSERT_FALSE(ends.empty());
  ASSERT_EQ(again.size(), ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    EXPECT_NEAR((again[i].position - ends[i].position).norm(), 0.0, 1e-6);
    EXPECT_NEAR((again[i].normal - ends[i].normal).norm(), 0.0, 1e-6);
    EXPECT_NEAR(again[i].bend, ends[i].bend, 1e-6);
  }
}

}  // namespace
}  // namespace instep
