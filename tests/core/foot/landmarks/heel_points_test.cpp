#include "core/foot/landmarks/heel_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "tests/support/cases/drawn_feet.h"
#include "tests/support/foot_body.h"

namespace instep {
namespace {

using Eigen::Vector3d;

FootScan marked(const PointCloud& cloud) {
  return align_foot(cloud).and_then(find_landmarks).value();
}

/// A simulated foot with enough of its leg, its sole seen.
FootScan foot_with_leg() {
  for (std::uint64_t seed = 1; seed < 100; ++seed) {
    const auto drawn = test::draw_scanned_foot_without_truth(seed);
    if (drawn.top_mm < 150.0 || !drawn.sole_is_seen) continue;
    const auto foot = align_foot(drawn.cloud).and_then(find_landmarks);
    if (foot && foot->landmarks.count("junction") > 0) return *foot;
  }
  throw std::runtime_error("no such foot was drawn");
}

/// A landmark of the foot as its outline has it, but for the side.
Landmark shifted(const FootOutline& outline, Landmark landmark, double along, double up) {
  landmark.position_mm *= outline.factor();
  landmark.position_mm += Vector3d(along, 0.0, up);
  return landmark;
}

/// Wherever the instep point is put: a heel that slopes otherwise draws the furthest point out of
/// the range, and may not take it along.
TEST(HeelPoint, StaysByTheLineThatFallsFromTheInstepPoint) {
  constexpr double kFall = 0.45;
  const Vector3d across(std::sin(kFall), 0.0, -std::cos(kFall));
  for (const auto& foot : {marked(test::FootBody{}.points()), foot_with_leg()}) {
    const FootOutline outline(foot);
    const double range = 0.1 * outline.length_mm();
    int found = 0;
    for (double along = -60.0; along <= 60.0; along += 15.0) {
      for (double up = -60.0; up <= 60.0; up += 15.0) {
        const auto instep = shifted(outline, foot.landmarks.at("instep_point"), along, up);
        for (const auto stance : {HeelStance::kOnFloor, HeelStance::kRaised}) {
          const auto heel = find_heel_point(outline, instep, stance);
          if (!heel) continue;
          ++found;
          EXPECT_LE(std::abs(across.dot(heel->position_mm - instep.position_mm)), range + 1e-6)
              << along << ", " << up;
        }
      }
    }
    EXPECT_GT(found, 100);
  }
}

TEST(Junction, LiesBetweenItsRaysOrIsNotFound) {
  const auto foot = foot_with_leg();
  const FootOutline outline(foot);
  int found = 0;
  int missing = 0;
  for (double along = -60.0; along <= 60.0; along += 15.0) {
    for (double up = -60.0; up <= 60.0; up += 15.0) {
      const auto heel = shifted(outline, foot.landmarks.at("heel_point"), along, up);
      const auto junction = find_junction(outline, heel);
      junction ? ++found : ++missing;
      if (!junction) continue;
      const Vector3d arm = junction->position_mm - heel.position_mm;
      const double rise = std::atan2(arm.z(), arm.x());
      EXPECT_GE(rise, 0.40) << along << ", " << up;
      EXPECT_LE(rise, 0.85) << along << ", " << up;
    }
  }
  EXPECT_GT(found, 20);
  EXPECT_GT(missing, 0) << "the rays pass by the foot from some places";
}

TEST(Junction, IsNotFoundWhereTheLegIsCutBelowIt) {
  auto foot = foot_with_leg();
  const double height = foot.landmarks.at("junction").position_mm.z();
  std::vector<std::size_t> low;
  for (std::size_t i = 0; i < foot.cloud.size(); ++i) {
    if (foot.cloud.positions[i].z() < height - 15.0) low.push_back(i);
  }
  foot.cloud = foot.cloud.subset(low);
  const FootOutline outline(foot);
  EXPECT_FALSE(find_junction(outline, shifted(outline, foot.landmarks.at("heel_point"), 0.0, 0.0)));
}

}  // namespace
}  // namespace instep
