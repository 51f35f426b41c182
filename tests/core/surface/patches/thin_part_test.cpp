#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/surface/patches/patch_fitter.h"
#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

constexpr double kSpacing = 0.02;

PatchFitter fitter_of(const OrientedPoints& points, double roughness = 0.01) {
  return {points, PointIndex(test::positions_of(points)), {{Vector3d::Zero(), roughness}}};
}

/// Two sheets as far apart as their points.
OrientedPoints plate_points() {
  OrientedPoints points;
  test::RandomNumbers random(2);
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 2500; ++i) {
      points.push_back(
          {{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0.5 * kSpacing * side},
           side * Vector3d::UnitZ(),
           0.0});
    }
  }
  return points;
}

/// A plate over x > 0 and the rim at which it ends.
OrientedPoints rimmed_plate_points(double thickness) {
  OrientedPoints points;
  test::RandomNumbers random(7);
  const auto about = [&](int step) { return kSpacing * (step + random.uniform(-0.3, 0.3)); };
  for (int j = -25; j <= 25; ++j) {
    for (const double side : {-1.0, 1.0}) {
      for (int i = 0; i < 20; ++i) {
        points.push_back({{about(i) + 0.5 * kSpacing, about(j), 0.5 * thickness * side},
                          side * Vector3d::UnitZ(),
                          0.0});
      }
    }
    for (int k = -1; k <= 1; ++k) {
      points.push_back({{0.0, about(j), about(k)}, -Vector3d::UnitX(), 0.0});
    }
  }
  return points;
}

/// A flat side and, over it, one in waves; each is told its variance, and is off by that much noise
/// below or above.
OrientedPoints bent_plate_points(double noise_below, double told_below, double told_above) {
  OrientedPoints points;
  test::RandomNumbers random(3);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform(-0.3, 0.3);
    const double y = random.uniform(-0.3, 0.3);
    const double z = 0.06 + 0.01 * std::sin(60.0 * x);
    const Vector3d up = Vector3d(-0.6 * std::cos(60.0 * x), 0.0, 1.0).normalized();
    points.push_back(
        {{x, y, noise_below * random.normal()}, -Vector3d::UnitZ(), told_below * told_below});
    points.push_back({{x, y, z}, up, told_above * told_above});
  }
  return points;
}

/// How far the field in space at `place` passes by its points that face as `facing` does, root mean
/// square.
double off_points(const OrientedPoints& points, const Vector3d& place, double facing) {
  const auto patch = fitter_of(points, 1e-7).fit(place).value();
  EXPECT_TRUE(std::holds_alternative<HermitePatch>(patch.field));
  double squares = 0.0;
  double count = 0.0;
  for (const auto member : patch.members) {
    if (points[member].normal.z() * facing < 0.0) continue;
    squares += std::pow(patch.at(points[member].position).value, 2);
    count += 1.0;
  }
  EXPECT_GT(count, 8.0);
  return std::sqrt(squares / count);
}

TEST(ThinPart, IsAFieldInSpaceOfBothSidesOfAPlate) {
  const auto points = plate_points();
  const auto fitter = fitter_of(points);
  for (const double side : {-1.0, 1.0}) {
    const Vector3d place(0.05, -0.1, 0.5 * kSpacing * side);
    const auto patch = fitter.fit(place);
    ASSERT_TRUE(patch);
    ASSERT_TRUE(std::holds_alternative<HermitePatch>(patch->field));
    EXPECT_NEAR(patch->at(place).value, 0.0, 0.05 * kSpacing);
    EXPECT_NEAR(patch->at(-place + Vector3d(0.1, -0.2, 0.0)).value, 0.0, 0.05 * kSpacing);
    EXPECT_LT(patch->at({0.05, -0.1, 0.0}).value, -0.2 * kSpacing);
    EXPECT_GT(patch->variance, 0.0);

    const auto sheet = patch->sheet_at(place);
    EXPECT_EQ(sheet.patch, nullptr);
    EXPECT_EQ(sheet.owner->variance, patch->variance);
    std::set<std::size_t> members;
    for (std::size_t i = 0; i < sheet.size(); ++i) members.insert(sheet.member(i));
    EXPECT_EQ(members.size(), sheet.size());
    EXPECT_EQ(members, std::set<std::size_t>(patch->members.begin(), patch->members.end()));
    for (const double facing : {-1.0, 1.0}) {
      EXPECT_GT(std::count_if(members.begin(), members.end(),
                              [&](auto i) { return points[i].normal.z() * facing > 0.0; }),
                20);
    }
  }
}

/// Scanned toes over a flat sole: their bends passed for noise where the sole was told to be
/// smooth, and the surface lay 1.7 mm beside a sole's exact points.
TEST(ThinPart, IsMetOnItsFlatSideWhereTheOtherIsBent) {
  const double harmless = 0.005 * kSpacing;
  const auto points = bent_plate_points(0.0, harmless, harmless);
  for (const double facing : {-1.0, 1.0}) {
    EXPECT_LT(off_points(points, Vector3d::Zero(), facing), 0.005 * kSpacing) << facing;
  }
}

TEST(ThinPart, IsNotExactOnBothSidesWhereOneIs) {
  const double sigma = 0.1 * kSpacing;
  const auto points = bent_plate_points(sigma, sigma, 0.005 * kSpacing);
  const Vector3d above(0.0, 0.0, 0.06);
  EXPECT_GT(off_points(points, above, -1.0), 0.5 * sigma) << "follows the noise";
}

/// The nearest points to its rim's edge lie on both sides of the plate, the nearer half of them on
/// one side and the rim.
TEST(ThinPart, HasTheEdgeOfItsRimWhereThePatchReachesRoundIt) {
  const double thickness = 3.5 * kSpacing;
  const auto points = rimmed_plate_points(thickness);
  const auto fitter = fitter_of(points);
  for (const double side : {-1.0, 1.0}) {
    const Vector3d edge(0.0, 0.03, 0.5 * thickness * side);
    const auto nearest = fitter.index().nearest(edge, 60);
    ASSERT_GT(
        std::count_if(nearest.begin(), nearest.end(),
                      [&](const auto& one) { return points[one.index].normal.z() * side < 0.0; }),
        6);
    const auto patch = fitter.fit(edge);
    ASSERT_TRUE(patch);
    const auto* creased = std::get_if<CreasedPatch>(&patch->field);
    ASSERT_NE(creased, nullptr);
    EXPECT_NEAR(creased->turn(), 0.5 * std::numbers::pi, 0.02);
    for (const double off : {0.01, 0.03}) {
      EXPECT_NEAR(patch->at(edge + Vector3d(off, 0.0, 0.0)).value, 0.0, 1e-6);
      EXPECT_NEAR(patch->at(edge - Vector3d(0.0, 0.0, off * side)).value, 0.0, 1e-6);
    }
  }
}

/// Two walls that run to an edge along y at the origin.
OrientedPoints wedge_points(double degrees, double sigma) {
  const double half = 0.5 * degrees * std::numbers::pi / 180.0;
  OrientedPoints points;
  test::RandomNumbers random(5);
  for (const double side : {-1.0, 1.0}) {
    const Vector3d along(std::cos(half), 0.0, side * std::sin(half));
    const Vector3d outward(-std::sin(half), 0.0, side * std::cos(half));
    for (int i = 0; i < 2500; ++i) {
      points.push_back({random.uniform(0.0, 1.0) * along +
                            random.uniform(-0.5, 0.5) * Vector3d::UnitY() +
                            sigma * random.normal() * outward,
                        outward, sigma * sigma});
    }
  }
  return points;
}

/// A field in space rounded it: of bodies with such edges girths were refused, or millimetres short
/// without a word.
TEST(ThinPart, HasAnAcuteEdge) {
  for (const double degrees : {20.0, 40.0, 60.0}) {
    for (const double sigma : {0.0, 0.04 * kSpacing}) {
      SCOPED_TRACE(testing::Message() << degrees << " " << sigma);
      const auto points = wedge_points(degrees, sigma);
      const auto patch = fitter_of(points).fit({0.25 * kSpacing, 0.1, 0.0});
      ASSERT_TRUE(patch);
      const auto* creased = std::get_if<CreasedPatch>(&patch->field);
      ASSERT_TRUE(creased);
      EXPECT_NEAR(creased->turn(), (180.0 - degrees) * std::numbers::pi / 180.0, 0.1);
      EXPECT_GT(patch->rounding, 0.0);
      // The tip lies as far off as noise of the walls moves where they meet.
      const double off =
          (0.1 * kSpacing + 2.0 * sigma) / std::sin(degrees * std::numbers::pi / 360.0);
      EXPECT_GT(patch->at({-off, 0.1, 0.0}).value, 0.0);
      EXPECT_LT(patch->at({off, 0.1, 0.0}).value, 0.0);
    }
  }
}

}  // namespace
}  // namespace instep
