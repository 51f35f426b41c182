#include "core/surface/patches/hermite_patch.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

OrientedPoints two_sides(double thickness, std::size_t each, double sigma, std::uint64_t seed) {
  const Vector3d up = Vector3d::UnitZ();
  auto points = test::disc_points(0.5 * thickness * up, up, 1.0, each, sigma, seed);
  const auto below = test::disc_points(-0.5 * thickness * up, -up, 1.0, each, sigma, seed + 1);
  points.insert(points.end(), below.begin(), below.end());
  return points;
}

/// The rim of a thin sole: its two sides and the half cylinder that joins them along x = 0.
OrientedPoints rim(double thickness, std::size_t count, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  const double radius = thickness / 2.0;
  OrientedPoints points;
  for (std::size_t i = 0; i < count; ++i) {
    const double y = random.uniform(-0.5, 0.5);
    const double along = random.uniform(-0.5, 0.5);
    if (std::abs(along) < std::numbers::pi / 2.0 * radius) {
      const double angle = along / radius;
      const Vector3d normal(std::cos(angle), 0.0, std::sin(angle));
      points.push_back({radius * normal + Vector3d(0, y, 0), normal, 0.0});
    } else {
      const double side = std::copysign(1.0, along);
      const double x = std::numbers::pi / 2.0 * radius - std::abs(along);
      points.push_back({{x, y, side * radius}, {0, 0, side}, 0.0});
    }
  }
  return points;
}

HermitePatch fit(const OrientedPoints& points) {
  return HermitePatch::fit(points, Vector3d::Zero(), 1.0, 0.01).value();
}

/// The one quadric that is zero with unit slope on the cylinder costs no roughness, so that it is
/// the answer whatever the smoothing.
TEST(HermitePatch, IsTheQuadricThatFitsACylinder) {
  const double radius = 0.8;
  for (const double variance : {0.0, 1e-4}) {
    test::RandomNumbers random(1);
    OrientedPoints points;
    for (int i = 0; i < 60; ++i) {
      const double angle = random.uniform(-1.0, 1.0);
      const Vector3d normal(std::sin(angle), 0.0, std::cos(angle));
      points.push_back(
          {radius * normal + random.uniform(-1, 1) * Vector3d::UnitY(), normal, variance});
    }
    const auto patch = HermitePatch::fit(points, {0, 0, radius}, 1.0, 0.01);
    ASSERT_TRUE(patch);
    for (int i = 0; i < 20; ++i) {
      const Vector3d place(random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5),
                           random.uniform(0.3, 1.0));
      const Vector3d across(place.x(), 0.0, place.z());
      EXPECT_NEAR(patch->at(place).value, (across.squaredNorm() - radius * radius) / (2.0 * radius),
                  1e-6);
      EXPECT_NEAR((patch->at(place).gradient - across / radius).norm(), 0.0, 1e-5);
    }
  }
}

TEST(HermitePatch, IsTheQuadricThatFitsAWholeSphere) {
  const auto patch = fit(test::sphere_points(0.7, 80, 0.0, 2));
  test::RandomNumbers random(3);
  for (int i = 0; i < 20; ++i) {
    const Vector3d place(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    EXPECT_NEAR(patch.at(place).value, (place.squaredNorm() - 0.49) / 1.4, 1e-6);
  }
}

TEST(HermitePatch, OfAPlaneIsTheDistanceFromIt) {
  const Vector3d normal = Vector3d(2, -1, 2).normalized();
  const Vector3d middle(50, -30, 20);
  const auto patch =
      HermitePatch::fit(test::disc_points(middle, normal, 3.0, 60, 0.0, 4), middle, 3.0, 0.01);
  ASSERT_TRUE(patch);
  for (const double distance : {-0.3, -0.03, 0.0, 0.03, 0.3}) {
    const auto field = patch->at(middle + 0.5 * normal.unitOrthogonal() + distance * normal);
    EXPECT_NEAR(field.value, distance, 1e-3);
    EXPECT_NEAR((field.gradient - normal).norm(), 0.0, 1e-2);
  }
}

TEST(HermitePatch, KnowsBothSidesOfAThinPlate) {
  for (const double thickness : {0.4, 0.1, 0.03}) {
    const auto patch = fit(two_sides(thickness, 50, 0.0, 5));
    for (const double side : {-1.0, 1.0}) {
      for (const double x : {-0.4, 0.0, 0.3}) {
        const auto field = patch.at({x, 0.1, side * 0.5 * thickness});
        EXPECT_NEAR(field.value, 0.0, 0.01 * thickness) << "thickness " << thickness;
        EXPECT_GT(field.gradient.normalized().z() * side, 0.99);
        EXPECT_GT(patch.at({x, 0.1, side * 0.6 * thickness}).value, 0.05 * thickness);
      }
    }
    EXPECT_LT(patch.at({0.1, 0.1, 0.0}).value, -0.2 * thickness);
  }
}

TEST(HermitePatch, FollowsTheRimOfASole) {
  const double thickness = 0.3;
  const auto patch = fit(rim(thickness, 200, 6));
  for (const double angle : {-1.4, -0.7, 0.0, 0.5, 1.2}) {
    const Vector3d normal(std::cos(angle), 0.0, std::sin(angle));
    const auto field = patch.at(0.5 * thickness * normal + Vector3d(0, 0.1, 0));
    EXPECT_NEAR(field.value, 0.0, 0.02 * thickness) << angle;
    EXPECT_GT(field.gradient.normalized().dot(normal), 0.99) << angle;
  }
}

TEST(HermitePatch, GradientIsThatOfItsValue) {
  const auto patch = fit(rim(0.3, 80, 7));
  const auto value = [&](const Vector3d& place) { return patch.at(place).value; };
  test::RandomNumbers random(8);
  for (int i = 0; i < 20; ++i) {
    const Vector3d place(random.uniform(-0.3, 0.3), random.uniform(-0.4, 0.4),
                         random.uniform(-0.3, 0.3));
    EXPECT_NEAR((patch.at(place).gradient - test::slope_by_differences(value, place, 1e-5)).norm(),
                0.0, 1e-6);
  }
}

TEST(HermitePatch, AveragesNoise) {
  const double sigma = 0.02;
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto patch =
        HermitePatch::fit(two_sides(0.4, 60, sigma, 2 * seed), Vector3d::Zero(), 1.0, 1e-3);
    ASSERT_TRUE(patch);
    for (const double side : {-0.2, 0.2}) {
      squares += std::pow(patch->at({0.1, 0.2, side}).value, 2) / 40.0;
    }
  }
  EXPECT_LT(std::sqrt(squares), 0.5 * sigma);
}

TEST(HermitePatch, IsTheSameInAnyUnit) {
  const auto points = two_sides(0.3, 40, 0.005, 9);
  const auto patch = fit(points);
  for (const double factor : {1e-3, 1e3}) {
    const auto other =
        HermitePatch::fit(test::scaled(points, factor), Vector3d::Zero(), factor, 0.01 / factor);
    ASSERT_TRUE(other);
    for (const double z : {-0.2, 0.0, 0.15}) {
      const Vector3d place(0.1, -0.2, z);
      EXPECT_NEAR(other->at(factor * place).value / factor, patch.at(place).value, 1e-7);
      EXPECT_NEAR((other->at(factor * place).gradient - patch.at(place).gradient).norm(), 0.0,
                  1e-6);
    }
  }
}

TEST(HermitePatch, OrderOfPointsDoesNotMatter) {
  const auto points = two_sides(0.3, 40, 0.005, 10);
  const auto patch = fit(points);
  const auto other = fit(test::in_another_order(points, 11));
  for (const double z : {-0.2, 0.0, 0.15}) {
    EXPECT_NEAR(other.at({0.1, -0.2, z}).value, patch.at({0.1, -0.2, z}).value, 1e-9);
  }
}

TEST(HermitePatch, TakesDuplicates) {
  auto points = test::sphere_points(0.7, 40, 0.0, 12);
  points.insert(points.end(), points.begin(), points.begin() + 20);
  const auto patch = HermitePatch::fit(points, Vector3d::Zero(), 1.0, 0.01);
  ASSERT_TRUE(patch);
  for (const auto& point : points) EXPECT_NEAR(patch->at(point.position).value, 0.0, 1e-6);
}

TEST(HermitePatch, RefusesNoPointsAndOnePlace) {
  const auto fits = [](const OrientedPoints& points) {
    return HermitePatch::fit(points, Vector3d::Zero(), 1.0, 0.01).has_value();
  };
  EXPECT_FALSE(fits({}));
  for (const double variance : {0.0, 1e-4}) {
    EXPECT_FALSE(fits(OrientedPoints(20, {Vector3d(0.1, 0.2, 0.3), Vector3d::UnitZ(), variance})));
  }
  EXPECT_TRUE(fits(two_sides(0.3, 20, 0.0, 13)));
}

}  // namespace
}  // namespace instep
