#include "core/geometry/scan_lines.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/support/random_numbers.h"
#include "tests/support/scanned_lines.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::ScannedLines;

std::vector<Vector3d> in_order(std::vector<Vector3d> points) {
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x(); });
  return points;
}

TEST(ScanLines, AreFoundRoundABodyAndAlongIt) {
  for (const bool round : {true, false}) {
    for (const auto& [apart, step] : {std::pair{10.0, 0.5}, {5.0, 0.5}, {8.0, 1.0}}) {
      const auto points = in_order(ScannedLines{40, 30, round, apart, step}.positions(1));
      EXPECT_TRUE(stand_in_lines(points, 10.0 * step)) << round << " " << apart;
      const auto lines = scan_lines(PointIndex(points), 40.0);
      ASSERT_TRUE(lines);
      EXPECT_NEAR(lines->apart / apart, 1.0, 0.2) << round << " " << apart;
      EXPECT_NEAR(lines->step / step, 1.0, 0.2) << round << " " << step;
    }
  }
}

/// The nearest of them are a round heap.
TEST(ScanLines, AreFoundWhereNoiseIsAsWideAsSomeSteps) {
  const auto points = in_order(ScannedLines{40, 30, true, 10.0, 0.25, 0.3}.positions(1));
  EXPECT_TRUE(stand_in_lines(points, 10.0));
  const auto lines = scan_lines(PointIndex(points), 40.0);
  ASSERT_TRUE(lines);
  EXPECT_NEAR(lines->apart / 10.0, 1.0, 0.3);
}

TEST(ScanLines, AreNotAmongEvenOrRandomPoints) {
  test::RandomNumbers random(3);
  std::vector<Vector3d> scattered;
  std::vector<Vector3d> lattice;
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j < 60; ++j) {
      scattered.emplace_back(random.uniform(0, 60), random.uniform(0, 60), 0.1 * random.normal());
      lattice.emplace_back(i, j, 0.0);
    }
  }
  EXPECT_FALSE(stand_in_lines(in_order(scattered), 5.0));
  EXPECT_FALSE(stand_in_lines(lattice, 5.0));
}

TEST(ScanLines, AreNotToldByOneAlone) {
  std::vector<Vector3d> ring;
  for (int i = 0; i < 300; ++i) {
    ring.emplace_back(40.0 * std::cos(i / 47.7), 40.0 * std::sin(i / 47.7), 0.0);
  }
  EXPECT_TRUE(stand_in_lines(in_order(ring), 10.0));
  EXPECT_FALSE(scan_lines(PointIndex(ring), 15.0));
}

TEST(ScanLines, OfAPointOrNoneAreNone) {
  EXPECT_FALSE(scan_lines(PointIndex({}), 10.0));
  EXPECT_FALSE(stand_in_lines({}, 10.0));
  EXPECT_FALSE(stand_in_lines(std::vector<Vector3d>(50, {1, 2, 3}), 10.0));
  EXPECT_FALSE(scan_lines(PointIndex({{1, 2, 3}}), 10.0));
  EXPECT_FALSE(scan_lines(PointIndex(std::vector<Vector3d>(50, {1, 2, 3})), 10.0));
}

}  // namespace
}  // namespace instep
