#include "core/foot/scanner_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/random_numbers.h"
#include "tests/support/scanned_lines.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

Points in_lines(double apart_mm, double step_mm) {
  return test::ScannedLines{40, 30, true, apart_mm, step_mm, 0.02}.positions(1);
}

TEST(ScannerLines, AreToldFromALittleMoreThanAMillimetreToSeven) {
  for (const double apart : {1.5, 2.0, 3.0, 5.0, 7.0}) {
    const auto lines = scanner_lines(in_lines(apart, 0.2 * apart));
    ASSERT_TRUE(lines) << apart;
    EXPECT_NEAR(lines->pitch / apart, 1.0, 0.1) << apart;
    EXPECT_GT(std::abs(lines->across.z()), 0.998) << apart;
  }
}

TEST(ScannerLines, AreNoneThatLieCloser) {
  EXPECT_FALSE(scanner_lines(in_lines(0.8, 0.16)));
}

TEST(ScannerLines, AreNotAmongPointsAtRandom) {
  test::RandomNumbers random(3);
  Points points;
  for (int i = 0; i < 20000; ++i) {
    const double turn = random.uniform(0.0, 6.28);
    points.emplace_back(40 * std::cos(turn), 30 * std::sin(turn), random.uniform(-100, 100));
  }
  EXPECT_FALSE(scanner_lines(points));
  EXPECT_FALSE(scanner_lines({}));
}

TEST(ScannerLines, AreTheSameInWhateverOrderPointsCome) {
  Points points = in_lines(3.0, 0.5);
  const auto lines = scanner_lines(points);
  std::shuffle(points.begin(), points.end(), std::mt19937(7));
  const auto again = scanner_lines(points);
  ASSERT_TRUE(lines && again);
  EXPECT_EQ(lines->pitch, again->pitch);
  EXPECT_EQ(lines->across, again->across);
}

}  // namespace
}  // namespace instep
