#include "core/girth/band/thinned_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/median.h"
#include "tests/support/scanned_lines.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::ScannedLines;

constexpr double kRadius = 40.0;

/// Lines along a round cylinder or round it.
PointCloud scanned(bool round, double apart, double step, double sigma) {
  PointCloud cloud;
  cloud.positions = ScannedLines{kRadius, kRadius, round, apart, step, sigma}.positions(1);
  return cloud;
}

PlaneSlab slab_of(const PointCloud& cloud) {
  return slab_of(cloud, TapePlane::through({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).value(), 20.0);
}

/// How far each place is from the cylinder.
std::vector<double> heights_of(const PlaneSlab& slab) {
  std::vector<double> heights;
  for (const auto& place : slab.places) heights.push_back(place.head<2>().norm() - kRadius);
  return heights;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(ThinnedLines, AreExactPointsThatWerePicked) {
  for (const bool round : {true, false}) {
    const auto cloud = scanned(round, 6.0, 0.2, 0.0);
    const PlaneSlab all = slab_of(cloud);
    const PlaneSlab few = thinned_lines(cloud, all, 6.0, true).slab;
    EXPECT_TRUE(few.shares.empty());
    for (std::size_t i = 0; i < few.indices.size(); ++i) {
      const auto known = std::find(all.indices.begin(), all.indices.end(), few.indices[i]);
      ASSERT_NE(known, all.indices.end());
      EXPECT_EQ(few.places[i], all.places[static_cast<std::size_t>(known - all.indices.begin())]);
    }
    EXPECT_LT(few.places.size(), all.places.size() / 3);
    EXPECT_GT(few.places.size(), all.places.size() / 8);
  }
}

/// A stretch of a sixth of the gap has five points: what noise they leave is less than half.
TEST(ThinnedLines, AreAveragesOfNoisyPointsWithoutAStepInwards) {
  for (const bool round : {true, false}) {
    const auto cloud = scanned(round, 6.0, 0.2, 0.3);
    const PlaneSlab few = thinned_lines(cloud, slab_of(cloud), 6.0, true).slab;
    const auto heights = heights_of(few);
    EXPECT_LT(root_mean_square(heights), 0.5 * 0.3);
    EXPECT_NEAR(mean(heights), 0.0, 0.02);
    ASSERT_EQ(few.shares.size(), few.places.size());
    EXPECT_NEAR(median(few.shares), std::sqrt(1.0 / 5.0), 0.1);
    EXPECT_NEAR(root_mean_square(heights) / (0.3 * median(few.shares)), 1.0, 0.25);
  }
}

/// They were of points on one side of their line, and as far off as if they were of two.
TEST(ThinnedLines, OfPointsFarFromTheirLineAreOfAllOfIt) {
  const auto cloud = scanned(false, 2.7, 0.09, 0.5);
  const PlaneSlab few = thinned_lines(cloud, slab_of(cloud), 2.7, true).slab;
  std::vector<double> off;
  for (const double height : heights_of(few)) off.push_back(std::abs(height));
  EXPECT_LT(median(off), 0.18);
}

/// No place of a line where noise puts single points: that would be a layer of its own.
TEST(ThinnedLines, LieNoneBesideAnother) {
  const auto cloud = scanned(true, 3.0, 0.1, 0.5);
  const PlaneSlab few = thinned_lines(cloud, slab_of(cloud), 3.0, true).slab;
  for (std::size_t i = 0; i < few.places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT((few.places[i] - few.places[j]).norm(), 0.35);
    }
  }
}

/// Each kept a cell of its own, or bent the average of its line.
TEST(ThinnedLines, LeaveOutStrays) {
  constexpr double kStrays = 0.005;
  for (const bool round : {true, false}) {
    for (const double sigma : {0.0, 0.1}) {
      PointCloud cloud;
      cloud.positions =
          ScannedLines{kRadius, kRadius, round, 4.0, 0.2, sigma, kStrays}.positions(1);
      const auto thinned = thinned_lines(cloud, slab_of(cloud), 4.0, true);
      for (const double height : heights_of(thinned.slab)) {
        EXPECT_NEAR(height, 0.0, std::max(6.0 * sigma, 1e-9)) << round << " " << sigma;
      }
      EXPECT_NEAR(thinned.stray_share, kStrays, 0.2 * kStrays) << round << " " << sigma;
    }
  }
}

/// Two scanners on the same lines, one of them a tenth as good.
TEST(ThinnedLines, BelieveTheBetterPoints) {
  auto good = scanned(true, 6.0, 0.4, 0.05);
  const auto bad = scanned(true, 6.0, 0.4, 0.5);
  good.sigma_mm.assign(good.positions.size(), 0.05);
  good.positions.insert(good.positions.end(), bad.positions.begin(), bad.positions.end());
  good.sigma_mm.resize(good.positions.size(), 0.5);
  const auto heights = heights_of(thinned_lines(good, slab_of(good), 6.0, true).slab);
  EXPECT_LT(root_mean_square(heights), 0.06);
}

TEST(ThinnedLines, OfNoneOrAFewAreThese) {
  PointCloud cloud;
  EXPECT_TRUE(thinned_lines(cloud, {}, 6.0, true).slab.places.empty());
  cloud.positions = {{1, 2, 0}, {30, 2, 0}, {1, 40, 0}};
  EXPECT_EQ(thinned_lines(cloud, slab_of(cloud), 6.0, true).slab.places.size(), 3U);
}

}  // namespace
}  // namespace instep
