#include "core/foot/cloud/scanner_lines.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "tests/support/random_numbers.h"
#include "tests/support/scanned_lines.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

Points in_lines(double apart_mm, double step_mm, double noise_mm = 0.02) {
  return test::ScannedLines{40, 30, true, apart_mm, step_mm, noise_mm}.positions(1);
}

/// An elliptic cylinder along z.
Vector3d on_cylinder(double turn, double level) {
  return {40 * std::cos(turn), 30 * std::sin(turn), level};
}

TEST(ScannerLines, AreToldFromALittleMoreThanAMillimetre) {
  for (const double apart : {1.5, 2.0, 3.0, 5.0, 7.0}) {
    const auto lines = scanner_lines(in_lines(apart, 0.2 * apart));
    ASSERT_TRUE(lines) << apart;
    EXPECT_NEAR(lines->pitch_mm / apart, 1.0, 0.003) << apart;
    EXPECT_GT(std::abs(lines->across.z()), 0.9999) << apart;
    EXPECT_NEAR(lines->step_mm / (0.2 * apart), 1.0, 0.15) << apart;
  }
}

TEST(ScannerLines, OfHardlyMorePointsThanLinesAreTold) {
  const auto lines = scanner_lines(in_lines(2.0, 1.2));
  ASSERT_TRUE(lines);
  EXPECT_NEAR(lines->pitch_mm, 2.0, 0.01);
}

TEST(ScannerLines, AreToldWhereNoiseIsATenthOfWhatTheyAreApart) {
  for (const double step : {0.1, 0.4, 1.0}) {
    const auto lines = scanner_lines(in_lines(2.0, step, 0.2));
    ASSERT_TRUE(lines) << step;
    EXPECT_NEAR(lines->pitch_mm, 2.0, 0.01) << step;
  }
}

TEST(ScannerLines, HowsoeverABodyIsTurned) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.9, 0.2, 0.3, -0.2).normalized();
  Points points = in_lines(4.0, 0.4, 0.1);
  for (auto& point : points) point = turn * point;
  const auto lines = scanner_lines(points);
  ASSERT_TRUE(lines);
  EXPECT_GT(std::abs(lines->across.dot(turn * Vector3d::UnitZ())), 0.9999);
  EXPECT_NEAR(lines->pitch_mm, 4.0, 0.01);
}

/// Of a scanner that is moved by hand.
TEST(ScannerLines, ThatAreUnevenlyApartAreTold) {
  test::RandomNumbers random(5);
  Points points;
  for (double level = -100.0; level < 100.0; level += 2.0 + random.uniform(-0.4, 0.4)) {
    for (double turn = 0.0; turn < 6.28; turn += 0.01) {
      points.push_back(on_cylinder(turn + random.uniform(0.0, 0.01), level));
    }
  }
  const auto lines = scanner_lines(points);
  ASSERT_TRUE(lines);
  EXPECT_NEAR(lines->pitch_mm, 2.0, 0.2);
}

/// Else some of a line would come with one beside it.
TEST(ScannerLines, HaveANumberThatAllTheirPointsShare) {
  for (const double apart : {1.5, 3.4}) {
    for (const double first : {0.0, 0.3, 0.5, 0.8}) {
      Points points = in_lines(apart, 0.3);
      for (auto& point : points) point.z() += first * apart;
      const auto lines = scanner_lines(points);
      ASSERT_TRUE(lines) << apart;
      const long long below = lines->line_of(points.front());
      const double upwards = lines->across.z() > 0.0 ? 1.0 : -1.0;
      for (const auto& point : points) {
        const double line = std::round((point.z() - points.front().z()) / apart);
        ASSERT_EQ(lines->line_of(point), below + std::llround(upwards * line)) << point.transpose();
      }
    }
  }
}

TEST(ScannerLines, AreNoneThatLieCloser) {
  EXPECT_FALSE(scanner_lines(in_lines(0.8, 0.16)));
}

/// So far apart they hardly show a foot; and a part of what they are apart is not taken for it.
TEST(ScannerLines, AreToldTenMillimetresApart) {
  for (const double apart : {8.0, 10.0, 14.0}) {
    const auto lines = scanner_lines(in_lines(apart, 0.3));
    ASSERT_TRUE(lines) << apart;
    EXPECT_NEAR(lines->pitch_mm / apart, 1.0, 0.01) << apart;
  }
}

/// As of a camera's pixels.
TEST(ScannerLines, AreRowsOfPixelsToo) {
  const auto rows = scanner_lines(in_lines(2.0, 1.8));
  ASSERT_TRUE(rows);
  EXPECT_FALSE(rows->are_apart());
  EXPECT_TRUE(scanner_lines(in_lines(2.0, 1.0))->are_apart());
}

/// As of a body on a turntable.
TEST(ScannerLines, AreNoneThatRunEveryWay) {
  Points points;
  for (double longitude = 0.0; longitude < 3.14; longitude += 0.1) {
    for (double latitude = 0.0; latitude < 6.28; latitude += 0.01) {
      const double level = std::sin(latitude);
      points.emplace_back(60 * level * std::cos(longitude), 60 * level * std::sin(longitude),
                          60 * std::cos(latitude));
    }
  }
  EXPECT_FALSE(scanner_lines(points));
}

TEST(ScannerLines, AreNotAmongPointsAtRandom) {
  test::RandomNumbers random(3);
  for (const std::size_t count : {300U, 3000U, 30000U}) {
    Points points;
    while (points.size() < count) {
      points.push_back(on_cylinder(random.uniform(0.0, 6.28), random.uniform(-100, 100)));
    }
    EXPECT_FALSE(scanner_lines(points)) << count;
  }
}

TEST(ScannerLines, AreNotAmongAFewPointsOrTheSameOne) {
  EXPECT_FALSE(scanner_lines({}));
  EXPECT_FALSE(scanner_lines(Points(20000, Vector3d(1, 2, 3))));
  EXPECT_FALSE(scanner_lines({{1, 2, 3}, {2, 3, 4}}));
}

TEST(ScannerLines, AreTheSameInWhateverOrderPointsCome) {
  Points points = in_lines(3.0, 0.5);
  const auto lines = scanner_lines(points);
  std::shuffle(points.begin(), points.end(), std::mt19937(7));
  const auto again = scanner_lines(points);
  ASSERT_TRUE(lines && again);
  EXPECT_EQ(lines->pitch_mm, again->pitch_mm);
  EXPECT_EQ(lines->across, again->across);
}

}  // namespace
}  // namespace instep
