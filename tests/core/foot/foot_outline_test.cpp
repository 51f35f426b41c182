#include "core/foot/foot_outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 260.0;
constexpr double kRimMm = 20.0;  ///< over the floor, of the lowest that was seen of one wall

/// A foot of which the lateral wall was seen, at y = -40, and of the medial one only what lies over
/// `kRimMm`, at y = 15, with a normal; on the platform below points were put as far as that.
FootOutline outline_with_rim(const Vector3d& normal) {
  FootScan foot;
  const auto add = [&](const Vector3d& place, const Vector3d& facing, PointOrigin origin) {
    foot.cloud.positions.push_back(place);
    foot.cloud.normals.push_back(facing);
    foot.cloud.origins.push_back(origin);
  };
  for (double x = 0.0; x <= kLength; x += 1.5) {
    for (double z = 0.0; z < 24.0; z += 1.5) {
      add({x, -40.0, z}, -Vector3d::UnitY(), PointOrigin::kSeen);
    }
    for (double up = 0.0; up < 24.0; up += 1.5) {
      const Vector3d back(0.0, -std::abs(normal.z()), std::abs(normal.y()));
      add(Vector3d(x, 15.0, kRimMm) + up * back, normal, PointOrigin::kSeen);
    }
    for (double y = -39.0; y <= 15.0; y += 1.5) {
      add({x, y, 0.0}, -Vector3d::UnitZ(), PointOrigin::kPlatform);
    }
  }
  foot.landmarks["pternion"].position_mm = Vector3d::Zero();
  foot.landmarks["acropodion"].position_mm = Vector3d(kLength, 0.0, 10.0);
  return FootOutline(foot);
}

/// Where cameras look from the other side, the skin ends at their horizon, tens of millimetres
/// inside the wall beyond: taken for that, a foot of 93 mm was 61 mm broad, to 5 mm.
TEST(FootOutline, HasNoBorderBelowAHorizon) {
  const FootOutline outline = outline_with_rim(Vector3d(0.0, 0.4, 0.9).normalized());
  EXPECT_TRUE(outline.medial().samples().empty());
  ASSERT_GT(outline.lateral().samples().size(), 100U);
  EXPECT_NEAR(*outline.lateral().reach(130.0), 40.0, 0.1);
}

/// As between two feet.
TEST(FootOutline, HasABorderBelowAWallThatWasLost) {
  const FootOutline outline = outline_with_rim(Vector3d(0.0, 0.95, 0.3).normalized());
  ASSERT_GT(outline.medial().samples().size(), 100U);
  EXPECT_NEAR(*outline.medial().reach(130.0), 15.0, 2.0);
}

}  // namespace
}  // namespace instep
