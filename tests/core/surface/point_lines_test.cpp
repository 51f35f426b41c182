#include "core/surface/point_lines.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Arms = std::vector<Vector3d>;

constexpr double kReach = 3.0;

/// Columns along a direction on the plane across `outward`, and how far they are from each other.
struct Columns {
  Vector3d outward;
  Vector3d across;
  double apart;
  double pitch;

  Arms within_reach(double shift) const {
    const Vector3d along = outward.cross(across);
    Arms arms;
    for (int column = -200; column <= 200; ++column) {
      for (int row = -200; row <= 200; ++row) {
        const Vector3d arm = (column + shift) * apart * across + (row + 0.3) * pitch * along;
        if (arm.norm() < kReach) arms.push_back(arm);
      }
    }
    return arms;
  }
};

double degrees_between(const Vector3d& a, const Vector3d& b) {
  return std::acos(std::min(std::abs(a.dot(b)), 1.0)) * 180.0 / std::numbers::pi;
}

TEST(PointLines, TellTheDirectionAndDistanceOfColumns) {
  test::RandomNumbers random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d outward =
        Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const Vector3d across =
        (Eigen::AngleAxisd(random.uniform(0.0, 7.0), outward) * outward.unitOrthogonal())
            .normalized();
    const Columns columns{outward, across, random.uniform(0.8, 1.4), 0.2};
    const auto lines = lines_among(columns.within_reach(random.uniform()), outward, kReach);
    EXPECT_NEAR(lines.across.norm(), 1.0, 1e-12);
    EXPECT_NEAR(lines.across.dot(outward), 0.0, 1e-12);
    EXPECT_LT(degrees_between(lines.across, across), 5.0);
    // Columns as long as the reach, seen 2.5 degrees from along them, come nearer to each other.
    EXPECT_LT(lines.apart, columns.apart + kReach / 30.0);
    EXPECT_GT(lines.apart, columns.apart - kReach / 10.0 - kReach / 30.0);
  }
}

TEST(PointLines, HeightsOverTheSurfaceDoNotMatter) {
  const Columns columns{Vector3d::UnitZ(), Vector3d::UnitY(), 1.0, 0.2};
  Arms arms = columns.within_reach(0.5);
  const auto flat = lines_among(arms, columns.outward, kReach);
  for (auto& arm : arms) arm.z() = 0.3 * arm.squaredNorm();
  const auto bent = lines_among(arms, columns.outward, kReach);
  EXPECT_EQ(bent.apart, flat.apart);
  EXPECT_EQ(bent.across, flat.across);
}

TEST(PointLines, PointsOnNoLinesAreAboutTheirSpacingApart) {
  constexpr int kPoints = 60;
  const double spacing = kReach * std::sqrt(std::numbers::pi / kPoints);
  test::RandomNumbers random(2);
  int wide = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Arms arms;
    for (int i = 0; i < kPoints; ++i) {
      const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
      const double far = kReach * std::sqrt(random.uniform());
      arms.emplace_back(far * std::cos(angle), far * std::sin(angle), 0.0);
    }
    const auto lines = lines_among(arms, Vector3d::UnitZ(), kReach);
    EXPECT_LT(lines.apart, 3.0 * spacing);
    wide += lines.apart > 1.5 * spacing ? 1 : 0;
  }
  EXPECT_LT(wide, 50);
}

TEST(PointLines, AHoleIsNoStripBetweenLines) {
  Arms arms;
  for (int i = -40; i <= 40; ++i) {
    for (int j = -40; j <= 40; ++j) {
      if (std::abs(i) > 10) arms.emplace_back(0.07 * i, 0.07 * j, 0.0);
    }
  }
  EXPECT_LT(lines_among(arms, Vector3d::UnitZ(), kReach).apart, 0.07 + kReach / 30.0);
}

/// Of points on one side of a hole, the hole is no strip between lines.
TEST(PointLines, WhatIsFreeBeyondTheOutermostPointsIsNoStrip) {
  Arms arms;
  for (int i = 0; i < 40; ++i) {
    for (int j = -40; j <= 40; ++j) arms.emplace_back(0.07 * i + 0.1, 0.07 * j, 0.0);
  }
  EXPECT_LT(lines_among(arms, Vector3d::UnitZ(), kReach).apart, 0.07 + kReach / 30.0);
}

}  // namespace
}  // namespace instep
