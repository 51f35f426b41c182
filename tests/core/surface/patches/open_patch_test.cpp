#include "core/surface/patches/open_patch.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/surface/patches/patch_fitter.h"
#include "tests/support/random_numbers.h"
#include "tests/support/sheet_points.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 0.35;
constexpr double kNoise = 0.0027;
constexpr double kSlit = 0.14;  ///< of the circle's length, round y = 0

Vector3d on_circle(double way) {
  return {kRadius * std::cos(way / kRadius), kRadius * std::sin(way / kRadius), 0.0};
}

/// Of a cylinder of which a strip along it was not seen.
std::vector<OrientedPoint> slit_cylinder(std::size_t count, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  const double half = std::numbers::pi * kRadius;
  std::vector<OrientedPoint> points;
  while (points.size() < count) {
    const double way = random.uniform(-half, half);
    if (std::abs(way) < 0.5 * kSlit) continue;
    const Vector3d normal = on_circle(way) / kRadius;
    const Vector3d up(0.0, 0.0, random.uniform(-0.12, 0.12));
    points.push_back({(kRadius + kNoise * random.normal()) * normal + up, normal, kNoise * kNoise});
  }
  return points;
}

/// Patches that just met both rims bulged by .05 to .15.
TEST(OpenPatch, IsFittedWiderSoThatItDoesNotBulge) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const PatchFitter fitter = test::fitter_of(slit_cylinder(20000, seed));
    for (double way = -0.5 * kSlit; way <= 0.5 * kSlit; way += 0.005) {
      const auto patch = fitter.fit(on_circle(way));
      ASSERT_TRUE(patch) << seed << " " << way;
      EXPECT_NEAR(patch->at(on_circle(way)).value, 0.0, 0.02) << seed << " " << way;
    }
  }
}

/// Two rows of points, `apart`, on a plane.
SurfacePatch patch_on_rims(double apart, double noise, std::vector<OrientedPoint>& points) {
  test::RandomNumbers random(3);
  for (int i = 0; i < 60; ++i) {
    const double x = (i % 2 == 0 ? 0.5 : -0.5) * (apart + random.uniform(0.0, 0.1));
    points.push_back({{x, random.uniform(-0.5, 0.5), noise * random.normal()},
                      Vector3d::UnitZ(),
                      noise * noise});
  }
  auto field = HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitZ(), 0.6, 1e-3);
  EXPECT_TRUE(field);
  SurfacePatch patch{Vector3d::Zero(), Vector3d::Zero(), 0.6, *field, {}};
  for (std::size_t i = 0; i < points.size(); ++i) patch.members.push_back(i);
  return patch;
}

TEST(OpenPatch, IsOneOfFarRimsWithNoise) {
  std::vector<OrientedPoint> points;
  const SurfacePatch noisy = patch_on_rims(0.9, 0.05, points);
  EXPECT_TRUE(is_open(noisy, 0.45, points));
  EXPECT_FALSE(is_open(noisy, 0.1, points)) << "a point is near its middle";
  points.clear();
  const SurfacePatch clean = patch_on_rims(0.9, 1e-4, points);
  EXPECT_FALSE(is_open(clean, 0.45, points));
}

}  // namespace
}  // namespace instep
