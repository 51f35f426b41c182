#include "core/foot/foot_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 260.0;
constexpr double kRimMm = 20.0;  ///< over the floor, of the lowest that was seen of one wall

/// A foot of which the lateral wall was seen, at 40 mm, and of the medial one only what lies over
/// `kRimMm`, at 15 mm, with a normal, as of a right foot, or nothing; on the platform below points
/// were put as far as that.
FootScan foot_with_rim(const std::optional<Vector3d>& normal, Side side = Side::kRight) {
  FootScan foot;
  foot.side = side;
  const auto add = [&](const Vector3d& place, const Vector3d& facing, PointOrigin origin) {
    const Vector3d as_right(1.0, foot.medial_sign(), 1.0);
    foot.cloud.positions.emplace_back(as_right.cwiseProduct(place));
    foot.cloud.normals.emplace_back(as_right.cwiseProduct(facing));
    foot.cloud.origins.push_back(origin);
  };
  for (double x = 0.0; x <= kLength; x += 1.5) {
    for (double z = 0.0; z < 24.0; z += 1.5) {
      add({x, -40.0, z}, -Vector3d::UnitY(), PointOrigin::kSeen);
    }
    for (double up = 0.0; normal && up < 24.0; up += 1.5) {
      const Vector3d back(0.0, -std::abs(normal->z()), std::abs(normal->y()));
      add(Vector3d(x, 15.0, kRimMm) + up * back, *normal, PointOrigin::kSeen);
    }
    for (double y = -39.0; y <= 15.0; y += 1.5) {
      add({x, y, 0.0}, -Vector3d::UnitZ(), PointOrigin::kPlatform);
    }
  }
  foot.is_closed_scan = true;
  foot.landmarks["pternion"].position_mm = Vector3d::Zero();
  foot.landmarks["acropodion"].position_mm = Vector3d(kLength, 0.0, 10.0);
  return foot;
}

const Vector3d kBackOfFoot = Vector3d(0.0, 0.4, 0.9).normalized();
const Vector3d kWall = Vector3d(0.0, 0.95, 0.3).normalized();

/// Where cameras look from the other side, they see the back of the foot last, tens of millimetres
/// inside the wall beyond: taken for that, a foot of 93 mm was 61 mm broad, to 5 mm.
TEST(FootOutline, HasNoBorderBelowTheLastOfTheBack) {
  for (const Side side : {Side::kRight, Side::kLeft}) {
    const FootOutline outline(foot_with_rim(kBackOfFoot, side));
    EXPECT_TRUE(outline.medial().samples().empty());
    ASSERT_GT(outline.lateral().samples().size(), 100U);
    EXPECT_NEAR(*outline.lateral().reach(130.0), 40.0, 0.1);
  }
}

TEST(FootOutline, HasNoBorderWhereTheOtherWallAloneWasSeen) {
  for (const Side side : {Side::kRight, Side::kLeft}) {
    const FootOutline outline(foot_with_rim(std::nullopt, side));
    EXPECT_TRUE(outline.medial().samples().empty());
    EXPECT_GT(outline.lateral().samples().size(), 100U);
  }
}

/// As between two feet.
TEST(FootOutline, HasABorderBelowAWallThatWasLost) {
  for (const Side side : {Side::kRight, Side::kLeft}) {
    const FootOutline outline(foot_with_rim(kWall, side));
    ASSERT_GT(outline.medial().samples().size(), 100U);
    EXPECT_NEAR(*outline.medial().reach(130.0), 15.0, 2.0);
  }
}

/// Tools that write normals need not know the outside.
TEST(FootOutline, TrustsNoNormalsButThoseOfAScan) {
  FootScan foot = foot_with_rim(-kWall);
  foot.is_closed_scan = false;
  EXPECT_GT(FootOutline(foot).medial().samples().size(), 100U);
}

}  // namespace
}  // namespace instep
