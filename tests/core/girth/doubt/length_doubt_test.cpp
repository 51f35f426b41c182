#include "core/girth/doubt/length_doubt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/prism_points.h"

namespace instep {
namespace {

using test::cylinder;
using test::kCylinderGirth;
using test::level_plane;

Girth girth_of(const PointCloud& cloud, const TapePlane& plane = level_plane()) {
  auto girth = girth_by_rbf(cloud, plane);
  EXPECT_TRUE(girth) << girth.error().line();
  return girth.value_or(Girth{});
}

/// How often intervals hold, and how wide they are, over bodies drawn anew.
struct Trials {
  int count = 0;
  int contact_held = 0;
  int stretched_held = 0;
  double squared_error = 0.0;  ///< mean, of the contact length
  double mean_u95 = 0.0;
};

Trials trials(int count, double truth_mm, const TapePlane& plane,
              const std::function<PointCloud(std::uint64_t seed)>& draw) {
  Trials sum;
  for (int i = 0; i < count; ++i) {
    const Girth girth = girth_of(draw(static_cast<std::uint64_t>(100 + i)), plane);
    const double error = girth.contact_mm - truth_mm;
    const double u95 = girth.contact_u95_mm.value_or(0.0);
    sum.count += 1;
    sum.contact_held += std::abs(error) <= u95;
    sum.stretched_held +=
        std::abs(girth.stretched_mm - truth_mm) <= girth.stretched_u95_mm.value_or(0.0);
    sum.squared_error += error * error / count;
    sum.mean_u95 += u95 / count;
  }
  return sum;
}

void expect_honest(const Trials& trials) {
  EXPECT_GE(trials.contact_held, 0.85 * trials.count);
  EXPECT_GE(trials.stretched_held, 0.85 * trials.count);
  EXPECT_LT(trials.mean_u95, 5.0 * std::sqrt(trials.squared_error));
}

TEST(LengthDoubt, HoldsForNoisyCylinders) {
  expect_honest(trials(60, kCylinderGirth, level_plane(),
                       [](std::uint64_t seed) { return cylinder(2500, 0.3, seed); }));
}

TEST(LengthDoubt, HoldsForFewPointsWithNoise) {
  expect_honest(trials(40, kCylinderGirth, level_plane(),
                       [](std::uint64_t seed) { return cylinder(600, 0.3, seed); }));
}

TEST(LengthDoubt, HoldsForNoisyEllipsesCutObliquely) {
  const auto shape = test::elliptic_cylinder(45, 30);
  const auto plane = test::oblique_plane();
  expect_honest(trials(40, test::true_girth(shape, plane), plane, [&](std::uint64_t seed) {
    return test::random_points(shape, 2500, -30, 30, 0.4, seed);
  }));
}

TEST(LengthDoubt, IsSmallForManyExactPoints) {
  const Girth girth = girth_of(cylinder(6000));
  EXPECT_LT(girth.contact_u95_mm.value(), 0.02);
  EXPECT_LT(girth.stretched_u95_mm.value(), 0.02);
  EXPECT_LE(std::abs(girth.contact_mm - kCylinderGirth), girth.contact_u95_mm.value());
  EXPECT_LE(std::abs(girth.stretched_mm - kCylinderGirth), girth.stretched_u95_mm.value());
}

double doubt_mm(std::size_t count, double sigma_mm) {
  double sum = 0.0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    sum += girth_of(cylinder(count, sigma_mm, seed)).contact_u95_mm.value() / 3.0;
  }
  return sum;
}

TEST(LengthDoubt, GrowsWithNoise) {
  const double least = doubt_mm(2500, 0.1);
  const double more = doubt_mm(2500, 0.3);
  const double most = doubt_mm(2500, 0.9);
  EXPECT_GT(more, 1.5 * least);
  EXPECT_GT(most, 1.5 * more);
}

TEST(LengthDoubt, GrowsWithFewerPoints) {
  const double least = doubt_mm(8000, 0.3);
  const double more = doubt_mm(2000, 0.3);
  const double most = doubt_mm(500, 0.3);
  EXPECT_GT(more, 1.3 * least);
  EXPECT_GT(most, 1.3 * more);
  EXPECT_GT(doubt_mm(500, 0.0), doubt_mm(5000, 0.0));
}

TEST(LengthDoubt, AddsSomeOfWhatASmoothSurfaceCutsOffEdges) {
  constexpr int kSides = 40;
  const auto corners = test::many_sided(kSides, 40.0, 40.0);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Girth girth = girth_of(test::prism_points(corners, 2500, seed));
    const double drawn = perimeter(girth.contour);
    EXPECT_LT(drawn, girth.contact_mm);
    EXPECT_LT(girth.contact_mm, perimeter(corners) + 0.05);
  }
}

TEST(LengthDoubt, AddsNothingToASmoothLine) {
  const Girth girth = girth_of(cylinder(2500, 0.0, 1));
  EXPECT_NEAR(girth.contact_mm, perimeter(girth.contour), 1e-3);
}

TEST(LengthDoubt, ScalesWithTheUnit) {
  PointCloud cloud = cylinder(2000, 0.3);
  const Girth before = girth_of(cloud);
  for (const double factor : {0.25, 8.0}) {
    PointCloud other = cloud;
    for (auto& position : other.positions) position *= factor;
    const Girth after = girth_of(other, level_plane(1.3 * factor));
    EXPECT_NEAR(after.contact_u95_mm.value(), factor * before.contact_u95_mm.value(),
                1e-9 * factor);
    EXPECT_NEAR(after.stretched_u95_mm.value(), factor * before.stretched_u95_mm.value(),
                1e-9 * factor);
  }
}

PointCloud with_hole(PointCloud cloud) {
  std::erase_if(cloud.positions,
                [](const auto& place) { return place.x() > 0.0 && std::abs(place.y()) < 7.0; });
  return cloud;
}

TEST(LengthDoubt, HoldsOverAHole) {
  expect_honest(trials(40, kCylinderGirth, level_plane(),
                       [](std::uint64_t seed) { return with_hole(cylinder(6000, 0.1, seed)); }));
}

/// What lies above and below a hole tells the skin over it. Of a ribbon no wider than many points
/// need against their noise, errors were .1 mm, and a fifth of the intervals did not hold.
TEST(LengthDoubt, HoldsOverARoundHoleAmongManyNoisyPoints) {
  const auto held = trials(12, kCylinderGirth, level_plane(), [](std::uint64_t seed) {
    PointCloud cloud = cylinder(100000, 0.3, seed);
    const Eigen::Vector3d middle(40.0, 0.0, level_plane().origin().z());
    std::erase_if(cloud.positions,
                  [&](const auto& place) { return (place - middle).norm() < 12.0; });
    return cloud;
  });
  EXPECT_GE(held.contact_held, 11);
  EXPECT_GE(held.stretched_held, 11);
  EXPECT_LT(std::sqrt(held.squared_error), 0.04);
}

/// Exact points leave no doubt but that of the surface between them; of a body that bends unevenly,
/// for a circular cylinder is told nearly as well over a hole.
TEST(LengthDoubt, IsLargerWithAHole) {
  const auto shape = test::elliptic_cylinder(45, 30);
  double whole = 0.0;
  double open = 0.0;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    const auto cloud = test::random_points(shape, 6000, -30, 30, 0.0, seed);
    whole += girth_of(cloud).contact_u95_mm.value();
    open += girth_of(with_hole(cloud)).contact_u95_mm.value();
  }
  EXPECT_GT(open, 3.0 * whole);
}

}  // namespace
}  // namespace instep
