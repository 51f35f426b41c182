#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "core/surface/patches/patch_fitter.h"
#include "core/surface/patches/patch_points.h"
#include "tests/support/bent_roof.h"
#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

/// Over two sheets that bend, as wide as a patch of them, with normals made of the points.
OrientedPoints bent_points(double turn, double sigma, std::uint64_t seed) {
  auto points = test::scaled(test::BentRoof{turn, 0.6, 0.3}.bare_points(40, 40, seed), 0.1);
  test::RandomNumbers random(seed);
  for (auto& point : points) {
    point.position += sigma * random.normal() * point.normal;
    point.variance = sigma * sigma;
  }
  return points;
}

std::optional<SurfacePatch> fit_amid(const OrientedPoints& points) {
  const PatchFitter fitter(points, PointIndex(test::positions_of(points)),
                           {{Vector3d::Zero(), 0.01}});
  return fitter.fit(Vector3d::Zero());
}

/// How many of twenty draws of them look creased to a patch in their midst.
int creased_of_twenty(double turn, double sigma) {
  int creased = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto patch = fit_amid(bent_points(turn, sigma, seed));
    EXPECT_TRUE(patch) << seed;
    creased += patch && std::holds_alternative<CreasedPatch>(patch->field);
  }
  return creased;
}

/// Noise of a thirty-eighth of the spacing hides none that turns plainly; a tenth is too much for
/// one that hardly does.
TEST(ClearCrease, IsSeenBetweenBentSheetsWhereThereIsHardlyNoise) {
  for (const double turn : {0.7, 1.0, 1.3}) EXPECT_EQ(creased_of_twenty(turn, 0.0), 20) << turn;
  for (const double turn : {0.9, 1.2}) EXPECT_EQ(creased_of_twenty(turn, 0.0005), 20) << turn;
  EXPECT_LT(creased_of_twenty(0.7, 0.002), 5);
  for (const double turn : {0.0, 0.3, 0.5}) EXPECT_EQ(creased_of_twenty(turn, 0.0), 0) << turn;
}

/// On the plane z = 0: so many at random over a square of side one.
OrientedPoints random_points(std::size_t count, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  OrientedPoints points(count);
  for (auto& point : points)
    point = {{random.uniform(), random.uniform(), 0.0}, Vector3d::UnitZ(), 0.0};
  return points;
}

/// Lines along y that are `stretch` steps apart.
OrientedPoints lined_points(double stretch) {
  constexpr double kApart = 0.08;
  OrientedPoints points;
  for (double x = 0.0; x < 1.0; x += kApart) {
    for (double y = 0.0; y < 1.0; y += kApart / stretch)
      points.push_back({{x, y, 0.0}, Vector3d::UnitZ(), 0.0});
  }
  return points;
}

bool are_clear_amid(const OrientedPoints& points) {
  const PatchPoints patches(points, PointIndex(test::positions_of(points)),
                            {{Vector3d::Zero(), 0.01}});
  return patches.are_clear(patches.surroundings_of({0.5, 0.5, 0.0}));
}

TEST(ClearPoints, AreQuietAndBareAndNotStrungOnLines) {
  int clear = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
    clear += are_clear_amid(random_points(800, seed));
  EXPECT_GE(clear, 98);
  EXPECT_TRUE(are_clear_amid(lined_points(1.0)));
  EXPECT_TRUE(are_clear_amid(lined_points(4.0)));
  EXPECT_FALSE(are_clear_amid(lined_points(14.0)));

  auto points = random_points(800, 1);
  const double spacing = 1.0 / std::sqrt(800.0);
  for (auto& point : points) point.variance = std::pow(0.03 * spacing, 2);
  EXPECT_TRUE(are_clear_amid(points));
  for (auto& point : points) point.variance = std::pow(0.1 * spacing, 2);
  EXPECT_FALSE(are_clear_amid(points));
  points = random_points(800, 1);
  for (auto& point : points) point.normal_told = true;
  EXPECT_FALSE(are_clear_amid(points));
}

}  // namespace
}  // namespace instep
