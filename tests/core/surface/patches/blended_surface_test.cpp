#include "core/surface/patches/blended_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

constexpr double kRadius = 0.5;

BlendedSurface surface_of(const OrientedPoints& points) {
  return BlendedSurface(
      PatchFitter(points, PointIndex(test::positions_of(points)), {{Vector3d::Zero(), 0.01}}));
}

Vector3d on_equator(double angle, double radius = kRadius) {
  return {radius * std::cos(angle), radius * std::sin(angle), 0.0};
}

/// Round the level circle of a sphere.
std::vector<Vector3d> equator(int count, double radius = kRadius) {
  std::vector<Vector3d> places;
  for (int i = 0; i < count; ++i) {
    places.push_back(on_equator(2.0 * std::numbers::pi * i / count, radius));
  }
  return places;
}

void visit_all(BlendedSurface& surface, const std::vector<Vector3d>& places) {
  for (const auto& place : places) EXPECT_TRUE(surface.visit(place)) << place.transpose();
}

TEST(BlendedSurface, IsZeroOnASphereAndSteepAcrossIt) {
  auto surface = surface_of(test::sphere_points(kRadius, 4000, 0.0, 1));
  visit_all(surface, equator(100));
  for (const auto& place : equator(333)) {
    const auto field = surface.at(place);
    ASSERT_TRUE(field);
    EXPECT_NEAR(field->value, 0.0, 1e-5);
    EXPECT_NEAR((field->gradient - place / kRadius).norm(), 0.0, 1e-2);
    EXPECT_GT(surface.at(1.01 * place)->value, 0.004);
    EXPECT_LT(surface.at(0.99 * place)->value, -0.004);
  }
}

TEST(BlendedSurface, GradientIsThatOfItsValueAcrossPatches) {
  for (const double sigma : {0.0, 0.003}) {
    auto surface = surface_of(test::sphere_points(kRadius, 2000, sigma, 2));
    visit_all(surface, equator(100));
    const auto value = [&](const Vector3d& place) { return surface.at(place).value().value; };
    for (const auto& place : equator(97, 1.005 * kRadius)) {
      EXPECT_NEAR(
          (surface.at(place)->gradient - test::slope_by_differences(value, place, 1e-6)).norm(),
          0.0, 1e-5);
    }
  }
}

TEST(BlendedSurface, NothingJumpsWherePatchesOverlap) {
  auto surface = surface_of(test::sphere_points(kRadius, 2000, 0.003, 3));
  visit_all(surface, equator(200));
  double before = surface.at(on_equator(0.0))->value;
  for (const auto& place : equator(20000)) {
    const double value = surface.at(place)->value;
    // The circle goes 1.6e-4 a step; the surface wanders over it by no more than a third of that.
    EXPECT_LT(std::abs(value - before), 5e-5);
    before = value;
  }
}

TEST(BlendedSurface, AveragesNoise) {
  for (const double sigma : {0.001, 0.003, 0.01}) {
    auto surface = surface_of(test::sphere_points(kRadius, 4000, sigma, 4));
    visit_all(surface, equator(100));
    double squares = 0.0;
    for (const auto& place : equator(200)) squares += std::pow(surface.at(place)->value, 2) / 200.0;
    EXPECT_LT(std::sqrt(squares), 0.5 * sigma);
  }
}

TEST(BlendedSurface, KeepsTheEdgesOfAPrism) {
  auto surface = surface_of(test::prism_points(1.0, 0.4, 0.025, 0.0, 5));
  std::vector<Vector3d> wall;
  for (int i = -20; i <= 20; ++i) wall.emplace_back(0.5, 0.025 * i, 0.0);
  visit_all(surface, wall);
  for (const auto& place : wall) EXPECT_NEAR(surface.at(place)->value, 0.0, 1e-3);
}

TEST(BlendedSurface, SpansAHole) {
  OrientedPoints rim;
  for (const auto& point : test::sphere_points(kRadius, 4000, 0.0, 6)) {
    if (std::acos(point.normal.x()) > 0.2) rim.push_back(point);
  }
  auto surface = surface_of(rim);
  std::vector<Vector3d> across;
  for (int i = -20; i <= 20; ++i) across.push_back(on_equator(0.02 * i));
  visit_all(surface, across);
  for (const auto& place : across) {
    ASSERT_TRUE(surface.at(place));
    // A flat cover over the hole would be 0.01 off.
    EXPECT_NEAR(surface.at(place)->value, 0.0, 1e-3);
  }
}

/// A plate 0.02 thick, its points 0.02 apart.
TEST(BlendedSurface, TellsTheTwoSidesOfAThinPlateApart) {
  OrientedPoints plate;
  test::RandomNumbers random(7);
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 2500; ++i) {
      plate.push_back({{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0.01 * side},
                       side * Vector3d::UnitZ(),
                       0.0});
    }
  }
  auto surface = surface_of(plate);
  std::vector<Vector3d> places;
  for (const double side : {-1.0, 1.0}) {
    for (int i = -10; i <= 10; ++i) places.emplace_back(0.03 * i, 0.01, 0.01 * side);
  }
  visit_all(surface, places);
  for (const auto& place : places) {
    const auto field = surface.at(place);
    ASSERT_TRUE(field);
    EXPECT_NEAR(field->value, 0.0, 5e-4);
    EXPECT_GT(field->gradient.normalized().z() * place.z(), 0.0099);
  }
}

TEST(BlendedSurface, AddsNoPatchWhereThereIsOneAndFewOnTheWhole) {
  auto surface = surface_of(test::sphere_points(kRadius, 4000, 0.0, 8));
  EXPECT_EQ(surface.patches(), 0U);
  visit_all(surface, equator(100));
  const auto patches = surface.patches();
  EXPECT_GE(patches, 1U);
  visit_all(surface, equator(100));
  EXPECT_EQ(surface.patches(), patches);
  visit_all(surface, equator(5000));
  EXPECT_LT(surface.patches(), 200U) << "as many as points along the circle";
}

TEST(BlendedSurface, OrderOfPointsDoesNotMatter) {
  const auto points = test::sphere_points(kRadius, 2000, 0.003, 9);
  auto surface = surface_of(points);
  auto other = surface_of(test::in_another_order(points, 10));
  visit_all(surface, equator(60));
  visit_all(other, equator(60));
  EXPECT_EQ(surface.patches(), other.patches());
  for (const auto& place : equator(77)) {
    EXPECT_NEAR(other.at(place)->value, surface.at(place)->value, 1e-9);
  }
}

TEST(BlendedSurface, TakesDuplicates) {
  auto points = test::sphere_points(kRadius, 3000, 0.0, 11);
  points.insert(points.end(), points.begin() + 1000, points.begin() + 2000);
  auto surface = surface_of(points);
  visit_all(surface, equator(60));
  for (const auto& place : equator(77)) EXPECT_NEAR(surface.at(place)->value, 0.0, 1e-4);
}

TEST(BlendedSurface, HasNoFieldWhereNoPatchReaches) {
  auto surface = surface_of(test::sphere_points(kRadius, 2000, 0.0, 12));
  EXPECT_FALSE(surface.at(on_equator(0.0))) << "nothing visited yet";
  ASSERT_TRUE(surface.visit(on_equator(0.0)));
  EXPECT_TRUE(surface.at(on_equator(0.0)));
  EXPECT_FALSE(surface.at(on_equator(std::numbers::pi)));
  EXPECT_FALSE(surface.at({100.0, 0.0, 0.0}));
}

TEST(BlendedSurface, DistanceToDataIsThatOfTheNearestPoint) {
  const auto points = test::sphere_points(kRadius, 500, 0.01, 13);
  const auto surface = surface_of(points);
  test::RandomNumbers random(14);
  for (int i = 0; i < 50; ++i) {
    const Vector3d place(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& point : points) {
      nearest = std::min(nearest, (point.position - place).norm());
    }
    EXPECT_NEAR(surface.distance_to_data(place), nearest, 1e-12);
  }
}

TEST(BlendedSurface, FitsNothingToOnePlace) {
  auto surface = surface_of(OrientedPoints(50, {Vector3d(0.1, 0.2, 0.3), Vector3d::UnitZ(), 0.0}));
  EXPECT_FALSE(surface.visit({0.1, 0.2, 0.3}));
  EXPECT_FALSE(surface.at({0.1, 0.2, 0.3}));
  EXPECT_EQ(surface.patches(), 0U);
}

TEST(BlendedSurface, IsFiniteOnAnything) {
  test::RandomNumbers random(15);
  const auto any = [&] {
    return Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  };
  OrientedPoints cloud;
  for (int i = 0; i < 500; ++i) cloud.push_back({any(), any().normalized(), 1e-6});
  auto surface = surface_of(cloud);
  int fields = 0;
  for (int i = 0; i < 50; ++i) {
    const Vector3d place = any();
    const bool fitted = surface.visit(place);
    const auto field = surface.at(place);
    EXPECT_TRUE(field || !fitted);
    if (!field) continue;
    ++fields;
    EXPECT_TRUE(std::isfinite(field->value));
    EXPECT_TRUE(field->gradient.allFinite());
  }
  EXPECT_GT(fields, 0);
}

/// Lines that set out from a dense part which the rest did not go on from asked for 18,000 patches,
/// none of which could be fitted: 150 s.
TEST(BlendedSurface, FitsNoMoreWhereAlmostNoPlaceHasAPatch) {
  auto points = test::sphere_points(kRadius, 2000, 0.0, 6);
  for (int i = 0; i < 200; ++i) {
    points.push_back({{20.0 + 0.01 * i, 0.0, 0.0}, Vector3d::UnitY(), 1e-18});
  }
  auto surface = surface_of(points);
  const Vector3d on_line(21.0, 0.0, 0.0);
  ASSERT_TRUE(surface.visit(on_equator(0.0)));
  for (int i = 0; i < 400; ++i) ASSERT_FALSE(surface.visit(on_line));
  EXPECT_TRUE(surface.visit(on_equator(1.0)));
  for (int i = 0; i < 200; ++i) ASSERT_FALSE(surface.visit(on_line));
  EXPECT_FALSE(surface.visit(on_equator(2.0)));
  EXPECT_TRUE(surface.visit(on_equator(1.0)));
}

}  // namespace
}  // namespace instep
