#include "core/geometry/strays/haze_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr std::size_t kSkin = 6000;

/// Of radius 1, so that a point has a square of .046 for itself.
Points skin_of(std::size_t count, double sigma = 0.0) {
  return test::positions_of(test::sphere_points(1.0, count, sigma, 3));
}

/// In a box under the ball, from .1 to .1 + `depth` below it.
void add_haze(std::size_t count, double depth, Points& points) {
  test::RandomNumbers random(11);
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                        -1.1 - random.uniform(0.0, depth));
  }
}

/// Of the skin, which comes first, and of what was added.
struct Found {
  std::ptrdiff_t of_skin = 0;
  std::ptrdiff_t of_haze = 0;
};

Found found_in(const Points& points, std::size_t skin = kSkin) {
  const auto found = haze_points(PointIndex(points));
  const auto border = found.begin() + static_cast<std::ptrdiff_t>(skin);
  return {std::count(found.begin(), border, true), std::count(border, found.end(), true)};
}

TEST(HazePoints, FillSpaceUnderASkin) {
  for (const double sigma : {0.0, 0.005}) {
    for (const double depth : {0.3, 1.0}) {
      Points points = skin_of(kSkin, sigma);
      add_haze(600, depth, points);
      const Found found = found_in(points);
      EXPECT_GT(found.of_haze, 570) << sigma << " " << depth;
      EXPECT_LT(found.of_skin, 12) << sigma << " " << depth;
    }
  }
}

TEST(HazePoints, AreNoneOfASkinAloneHoweverNoisy) {
  for (const double sigma : {0.0, 0.01, 0.03, 0.06}) {
    EXPECT_EQ(found_in(skin_of(kSkin, sigma)).of_skin, 0) << sigma;
  }
}

TEST(HazePoints, AreNoneOfTooFew) {
  Points points = skin_of(kSkin);
  add_haze(20, 0.3, points);
  EXPECT_EQ(found_in(points).of_haze, 0);
  EXPECT_EQ(found_in(skin_of(12), 12).of_skin, 0);
  EXPECT_TRUE(haze_points(PointIndex(Points{})).empty());
}

/// Far apart one from the other, but in a plane.
TEST(HazePoints, AreNoneOfASparseSheetBesideADenserOne) {
  Points points = skin_of(kSkin);
  test::RandomNumbers random(13);
  for (int i = 0; i < 400; ++i) {
    points.emplace_back(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), -1.3);
  }
  const Found found = found_in(points);
  EXPECT_EQ(found.of_haze, 0);
  EXPECT_EQ(found.of_skin, 0);
}

/// Of a laser scanner: all neighbours lie on one bent line.
TEST(HazePoints, AreNoneOfSkinInLines) {
  Points points;
  for (int line = 1; line < 20; ++line) {
    const double polar = std::numbers::pi * line / 20.0;
    for (int i = 0; i < 400; ++i) {
      const double around = 2.0 * std::numbers::pi * i / 400.0;
      points.emplace_back(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
                          std::cos(polar));
    }
  }
  EXPECT_EQ(found_in(points, points.size()).of_skin, 0);
}

}  // namespace
}  // namespace instep
