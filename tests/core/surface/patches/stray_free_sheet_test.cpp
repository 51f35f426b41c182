#include "core/surface/patches/stray_free_sheet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/oriented_points.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

constexpr double kSphere = 2.0;
constexpr double kNoise = 0.002;

std::optional<HeightPatch> cap_patch(const OrientedPoints& points) {
  return HeightPatch::fit(points, Vector3d(0, 0, kSphere), Vector3d::UnitZ(), 1.0, 0.01);
}

/// Those that are left out.
std::vector<std::size_t> strays_of(const OrientedPoints& points) {
  const auto sheet = StrayFreeSheet::of(points, cap_patch).value();
  std::vector<std::size_t> strays;
  auto kept = sheet.numbers.begin();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (kept != sheet.numbers.end() && *kept == i) {
      ++kept;
    } else {
      strays.push_back(i);
    }
  }
  EXPECT_EQ(kept, sheet.numbers.end());
  return strays;
}

void lift(double height, OrientedPoint& point) {
  point.position += height * point.normal;
}

/// The number of the point nearest to one.
std::size_t next_to(std::size_t one, const OrientedPoints& points) {
  std::size_t best = one == 0 ? 1 : 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto apart = [&](std::size_t other) {
      return (points[one].position - points[other].position).norm();
    };
    if (i != one && apart(i) < apart(best)) best = i;
  }
  return best;
}

TEST(StrayFreeSheet, IsFittedOnceWhereNoneIs) {
  for (const auto& [count, noise] : {std::pair(60U, 0.0), {60U, kNoise}, {400U, kNoise}}) {
    const auto points = test::cap_points(kSphere, 1.0, count, noise, 21);
    int fits = 0;
    const auto sheet = StrayFreeSheet::of(points, [&](const OrientedPoints& some) {
      ++fits;
      return cap_patch(some);
    });
    ASSERT_TRUE(sheet);
    EXPECT_EQ(fits, 1) << count << " " << noise;
    EXPECT_EQ(sheet->numbers.size(), count) << noise;
  }
}

TEST(StrayFreeSheet, IsNoneWherePointsTellNone) {
  EXPECT_FALSE(StrayFreeSheet::of({}, cap_patch));
  EXPECT_FALSE(StrayFreeSheet::of(OrientedPoints(20, {Vector3d(0, 0, kSphere), Vector3d::UnitZ()}),
                                  cap_patch));
}

TEST(StrayFreeSheet, LeavesOutAStray) {
  for (const double noise : {0.0, kNoise}) {
    auto points = test::cap_points(kSphere, 1.0, 60, noise, 21);
    lift(0.2, points[23]);
    EXPECT_EQ(strays_of(points), std::vector<std::size_t>{23}) << noise;
    const auto sheet = StrayFreeSheet::of(points, cap_patch).value();
    const Vector3d place = kSphere * points[23].position.normalized();
    EXPECT_NEAR(sheet.patch.at(place).value, 0.0, 1e-5 + 6.0 * noise);
  }
}

/// The first that is found gains less than a stray has to.
TEST(StrayFreeSheet, LeavesOutTwoSideBySide) {
  auto points = test::cap_points(kSphere, 1.0, 60, 0.0, 21);
  const std::size_t other = next_to(23, points);
  lift(0.2, points[23]);
  lift(0.2, points[other]);
  EXPECT_EQ(strays_of(points),
            (std::vector{std::min<std::size_t>(23, other), std::max<std::size_t>(23, other)}));
}

/// All of its cell was left out with it.
TEST(StrayFreeSheet, LeavesOutNoMoreThanTheStrayOfAveragedPoints) {
  auto points = test::cap_points(kSphere, 1.0, 400, kNoise, 22);
  lift(0.4, points[77]);
  EXPECT_EQ(strays_of(points), std::vector<std::size_t>{77});
}

/// A bump no wider than a cell was left out with all its points.
TEST(StrayFreeSheet, KeepsABumpThatMostPointsOfACellTell) {
  for (const double width : {0.1, 0.15}) {
    auto points = test::cap_points(kSphere, 1.0, 400, kNoise, 23);
    for (auto& point : points) {
      const double squared = point.position.head<2>().squaredNorm();
      lift(0.03 * std::exp(-squared / (2.0 * width * width)), point);
    }
    EXPECT_GT(cap_patch(points)->odd_one().gain, 30.0) << width;
    EXPECT_TRUE(strays_of(points).empty()) << width;
  }
}

}  // namespace
}  // namespace instep
