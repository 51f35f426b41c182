#include <gtest/gtest.h>

#include <optional>
#include <variant>
#include <vector>

#include "core/surface/patch_fitter.h"
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

/// Noise of a twenty-fifth of the spacing hides none that turns plainly; a twelfth is too much for
/// one that hardly does.
TEST(ClearCrease, IsSeenBetweenBentSheetsWhereThereIsHardlyNoise) {
  for (const double turn : {0.7, 1.0, 1.3}) EXPECT_EQ(creased_of_twenty(turn, 0.0), 20) << turn;
  for (const double turn : {0.9, 1.2}) EXPECT_EQ(creased_of_twenty(turn, 0.0005), 20) << turn;
  EXPECT_LT(creased_of_twenty(0.7, 0.001), 5);
  for (const double turn : {0.0, 0.3, 0.5}) EXPECT_EQ(creased_of_twenty(turn, 0.0), 0) << turn;
}

}  // namespace
}  // namespace instep
