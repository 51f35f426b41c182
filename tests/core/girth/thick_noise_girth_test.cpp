// Girths of dense clouds whose noise is several times as thick as their points are apart.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::oblique_plane;
using test::RandomNumbers;

/// By how much a point with that normal is off.
using Noise = std::function<Vector3d(const Vector3d& normal, RandomNumbers& random)>;

Vector3d along_normal(const Vector3d& normal, RandomNumbers& random) {
  return random.normal() * normal;
}

Vector3d all_round(const Vector3d& /*normal*/, RandomNumbers& random) {
  return {random.normal(), random.normal(), random.normal()};
}

/// Of four cameras round the body each point is seen by the one that it faces.
Vector3d along_rays(const Vector3d& normal, RandomNumbers& random) {
  const bool front = std::abs(normal.x()) > std::abs(normal.y());
  return random.normal() * (front ? Vector3d::UnitX() : Vector3d::UnitY());
}

PointCloud noisy_cylinder(std::size_t count, double sigma_mm, const Noise& noise,
                          std::uint64_t seed) {
  RandomNumbers random(seed);
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Vector3d normal(std::cos(angle), std::sin(angle), 0.0);
    const Vector3d place = 40.0 * normal + random.uniform(-30.0, 30.0) * Vector3d::UnitZ();
    cloud.positions.push_back(place + sigma_mm * noise(normal, random));
  }
  return cloud;
}

double true_girth() {
  return test::true_girth(test::elliptic_cylinder(40, 40), oblique_plane());
}

/// The noise was told as 0.6 to 0.8 of it: of a million points some girths were twice their
/// interval off, others were refused.
TEST(ThickNoiseGirth, IsToldRightWithItsNoise) {
  struct Crowd {
    std::size_t points;
    double sigma_mm;
  };
  for (const auto& [points, sigma_mm] : {Crowd{300000, 1.0}, Crowd{1000000, 0.5}}) {
    const auto cloud = noisy_cylinder(points, sigma_mm, along_normal, 1);
    const auto girth = girth_by_rbf(cloud, oblique_plane());
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_NEAR(girth->contact_mm, true_girth(), *girth->contact_u95_mm);
    EXPECT_NEAR(girth->stretched_mm, true_girth(), *girth->stretched_u95_mm);
    EXPECT_LT(*girth->contact_u95_mm, 0.3 * sigma_mm);
    EXPECT_NEAR(girth->sigma_mm, sigma_mm, 0.1 * sigma_mm);
  }
}

TEST(ThickNoiseGirth, HoldsInWhicheverDirectionPointsAreOff) {
  int held = 0;
  for (const Noise& noise : {Noise(along_normal), Noise(all_round), Noise(along_rays)}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const auto girth = girth_by_rbf(noisy_cylinder(60000, 1.0, noise, seed), oblique_plane());
      ASSERT_TRUE(girth) << girth.error().line();
      if (std::abs(girth->contact_mm - true_girth()) <= *girth->contact_u95_mm) ++held;
    }
  }
  EXPECT_GE(held, 8);
}

/// Where it bends much noise along normals puts it most too low: of these one in six held.
TEST(ThickNoiseGirth, HoldsOfLongSections) {
  const auto shape = test::elliptic_cylinder(50, 20);
  const double truth = test::true_girth(shape, oblique_plane());
  int held = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    const auto cloud = test::random_points(shape, 200000, -40, 40, 1.0, seed);
    const auto girth = girth_by_rbf(cloud, oblique_plane());
    ASSERT_TRUE(girth) << girth.error().line();
    if (std::abs(girth->contact_mm - truth) <= *girth->contact_u95_mm) ++held;
  }
  EXPECT_GE(held, 5);
}

}  // namespace
}  // namespace instep
