#include "core/foot/standing/whole_leg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/foot/alignment.h"
#include "tests/support/foot_body.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// The foot with its wall drawn on up to a height over the sole: wider at the calf, and leaning.
PointCloud with_leg(double height_mm, double lean_deg = 0.0) {
  PointCloud cloud = test::FootBody{}.points();
  double top = 0.0;
  for (const auto& point : cloud.positions) top = std::max(top, point.z());
  std::vector<Vector3d> ring;
  for (const auto& point : cloud.positions) {
    if (point.z() > top - 3.0 && point.x() < 100.0) ring.push_back(point);
  }
  Vector3d middle = Vector3d::Zero();
  for (const auto& point : ring) middle += point / static_cast<double>(ring.size());
  const double lean = std::tan(lean_deg * std::numbers::pi / 180.0);
  for (double z = top + 3.0; z < height_mm; z += 3.0) {
    const double calf = std::sin(std::min(1.0, (z - top) / 400.0) * std::numbers::pi);
    for (const auto& point : ring) {
      const Vector3d arm = (1.0 + 0.3 * calf * calf) * (point - middle);
      cloud.positions.emplace_back(middle.x() + arm.x() + lean * (z - top), middle.y() + arm.y(),
                                   z);
    }
  }
  cloud.normals.clear();
  return cloud;
}

double length_of(const FootScan& foot) {
  return foot.landmarks.at("acropodion").position_mm.x();
}

bool is_leg_told(const FootScan& foot) {
  return std::any_of(foot.warnings.begin(), foot.warnings.end(),
                     [](const auto& one) { return one.find("most of a leg") != one.npos; });
}

/// Above some 500 mm of leg, clouds were refused as feet of 600 to 1,000 mm.
TEST(WholeLeg, IsLeftOutInAnyPose) {
  const double length = length_of(align_foot(test::FootBody{}.points()).value());
  const RigidTransform lying(Eigen::AngleAxisd(1.6, Vector3d(1.0, 2.0, 0.3).normalized()));
  for (const double height : {420.0, 500.0, 600.0, 1000.0}) {
    for (const double lean : {0.0, 12.0, -12.0}) {
      const PointCloud standing = with_leg(height, lean);
      for (const auto& cloud : {standing, transformed(lying, standing)}) {
        const auto foot = align_foot(cloud);
        ASSERT_TRUE(foot) << height << " " << lean << " " << foot.error().line();
        EXPECT_NEAR(length_of(*foot), length, 0.5) << height << " " << lean;
        EXPECT_TRUE(is_leg_told(*foot)) << height << " " << lean;
      }
    }
  }
}

TEST(WholeLeg, IsNoneThatIsNotFarLongerThanTheFoot) {
  for (const double height : {90.0, 150.0, 250.0, 340.0}) {
    EXPECT_FALSE(foot_under_leg(with_leg(height).positions)) << height;
  }
}

TEST(WholeLeg, IsNoOtherBody) {
  EXPECT_FALSE(foot_under_leg({}));
  EXPECT_FALSE(foot_under_leg({Vector3d(1.0, 2.0, 3.0)}));
  std::vector<Vector3d> pillar;
  for (double z = 0.0; z < 900.0; z += 4.0) {
    for (double angle = 0.0; angle < 6.28; angle += 0.05)
      pillar.emplace_back(90.0 * std::cos(angle), 90.0 * std::sin(angle), z);
  }
  EXPECT_FALSE(foot_under_leg(pillar));
  // A ruler beside a foot is told from it elsewhere, and a box behind it.
  auto with_ruler = with_leg(150.0).positions;
  for (double x = -500.0; x < 260.0; x += 3.0) {
    for (double y = 80.0; y < 110.0; y += 3.0) with_ruler.emplace_back(x, y, 2.0);
  }
  EXPECT_FALSE(foot_under_leg(with_ruler));
  auto with_box = with_leg(150.0).positions;
  for (double x = -250.0; x < -30.0; x += 3.0) {
    for (double y = -80.0; y < 80.0; y += 3.0) {
      with_box.emplace_back(x, y, 0.0);
      with_box.emplace_back(x, y, 150.0);
    }
  }
  EXPECT_FALSE(foot_under_leg(with_box));
  auto on_floor = with_leg(600.0).positions;
  for (double x = -400.0; x < 600.0; x += 5.0) {
    for (double y = -400.0; y < 400.0; y += 5.0) on_floor.emplace_back(x, y, 0.0);
  }
  EXPECT_FALSE(foot_under_leg(on_floor));
}

}  // namespace
}  // namespace instep
