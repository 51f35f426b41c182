#include "core/surface/patches/patch_fitter.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"
#include "tests/support/sheet_points.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;
using test::cylinder_columns;
using test::fitter_of;
using test::kSpacing;
using test::plane_points;

/// Of a hexagonal prism along z, each wall `width` wide; walls begin at edges at whole sixths of a
/// turn.
struct Hexagon {
  double width;

  static double angle(int sixth) { return std::numbers::pi / 3.0 * sixth; }
  Vector3d edge(int sixth) const {
    return width * Vector3d(std::cos(angle(sixth)), std::sin(angle(sixth)), 0.0);
  }
  static Vector3d normal(int wall) {
    const double turned = angle(wall) + std::numbers::pi / 6.0;
    return {std::cos(turned), std::sin(turned), 0.0};
  }
  /// `part` of the way from the wall's first edge to its second one.
  Vector3d at(int wall, double part) const {
    return (1.0 - part) * edge(wall) + part * edge(wall + 1);
  }

  OrientedPoints points(int columns, std::uint64_t seed) const {
    test::RandomNumbers random(seed);
    const double step = width / columns;
    OrientedPoints points;
    for (int wall = 0; wall < 6; ++wall) {
      for (int row = -20; row <= 20; ++row) {
        for (int i = 0; i < columns; ++i) {
          const double part = (i + random.uniform(0.2, 0.8)) / columns;
          const Vector3d up(0.0, 0.0, step * (row + random.uniform(-0.3, 0.3)));
          points.push_back({at(wall, part) + up, normal(wall), 0.0});
        }
      }
    }
    return points;
  }
};

std::set<std::size_t> members_of(const SurfacePatch::Sheet& sheet) {
  std::set<std::size_t> members;
  for (std::size_t i = 0; i < sheet.size(); ++i) members.insert(sheet.member(i));
  EXPECT_EQ(members.size(), sheet.size()) << "a point counts twice";
  return members;
}

/// Those within `radius` of a place.
std::set<std::size_t> points_within(const OrientedPoints& points, const Vector3d& place,
                                    double radius) {
  std::set<std::size_t> within;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if ((points[i].position - place).norm() <= radius * (1.0 + 1e-12)) within.insert(i);
  }
  return within;
}

/// The same, seen along `outward`.
std::set<std::size_t> points_beside(const OrientedPoints& points, const Vector3d& place,
                                    double radius, const Vector3d& outward) {
  std::set<std::size_t> within;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off = outward.cross(points[i].position - place).norm();
    if (off <= radius * (1.0 + 1e-12)) within.insert(i);
  }
  return within;
}

Vector3d middle_of(const OrientedPoints& points, const std::vector<std::size_t>& members) {
  Vector3d sum = Vector3d::Zero();
  for (const auto i : members) sum += points[i].position;
  return sum / static_cast<double>(members.size());
}

TEST(PatchFitter, MakesOneSmoothSheetOfAPlane) {
  for (const double sigma : {0.0, 0.002}) {
    const auto points = plane_points(sigma);
    const auto fitter = fitter_of(points);
    for (const Vector3d& place : {Vector3d(0, 0, 0), Vector3d(0.2, -0.1, 0.003)}) {
      const auto patch = fitter.fit(place);
      ASSERT_TRUE(patch);
      ASSERT_TRUE(std::holds_alternative<HeightPatch>(patch->field));
      EXPECT_NEAR(patch->at(place).value, place.z(), 1e-9 + sigma);
      EXPECT_GT(patch->at(place).gradient.normalized().z(), 0.99);
      EXPECT_EQ(patch->variance, 0.0);

      const auto sheet = patch->sheet_at(place);
      EXPECT_EQ(sheet.patch, std::get_if<HeightPatch>(&patch->field));
      EXPECT_TRUE(sheet.is_same(patch->sheet_at(place + Vector3d(0.01, 0.02, -0.03))));
      EXPECT_EQ(members_of(sheet), points_beside(points, place, patch->radius, Vector3d::UnitZ()));
      EXPECT_GE(sheet.size(), 60U);
      EXPECT_NEAR((patch->middle - middle_of(points, patch->members)).norm(), 0.0, 1e-12);
    }
  }
}

TEST(PatchFitter, IsWiderWhereThereIsNoise) {
  const auto exact = fitter_of(plane_points(0.0)).fit(Vector3d::Zero());
  const auto noisy = fitter_of(plane_points(0.004)).fit(Vector3d::Zero());
  ASSERT_TRUE(exact && noisy);
  EXPECT_GT(noisy->members.size(), exact->members.size());
  EXPECT_GT(noisy->radius, 1.05 * exact->radius);
}

TEST(PatchFitter, MakesTwoSheetsOfARightAngledEdge) {
  const auto points = test::prism_points(1.0, 0.4, kSpacing, 0.0, 3);
  const auto patch = fitter_of(points).fit({0.5, 0.5, 0.0});
  ASSERT_TRUE(patch);
  const auto* creased = std::get_if<CreasedPatch>(&patch->field);
  ASSERT_NE(creased, nullptr);
  EXPECT_NEAR(creased->turn(), 0.5 * std::numbers::pi, 0.02);
  for (const double off : {0.01, 0.03, 0.06}) {
    EXPECT_NEAR(patch->at({0.5, 0.5 - off, 0.0}).value, 0.0, 1e-6);
    EXPECT_NEAR(patch->at({0.5 - off, 0.5, 0.0}).value, 0.0, 1e-6);
    EXPECT_LT(patch->at({0.5 - off, 0.5 - off, 0.0}).value, -0.9 * off);
  }
}

/// The sheet at a place of a wall is made of the points of that wall, those of the other wall are
/// the other sheet's, and there are no more.
TEST(PatchFitter, SheetsOfAnEdgeAreThePointsOfTheTwoWalls) {
  const auto points = test::prism_points(1.0, 0.4, kSpacing, 0.0, 3);
  const Vector3d edge(0.5, 0.5, 0.0);
  const auto patch = fitter_of(points).fit(edge);
  ASSERT_TRUE(patch);
  std::set<std::size_t> on_x, on_y;
  for (const auto i : patch->members) {
    (points[i].normal.x() > 0.5 ? on_x : on_y).insert(i);
  }
  ASSERT_GE(on_x.size(), 6U);
  ASSERT_GE(on_y.size(), 6U);
  const auto sheet_x = patch->sheet_at({0.5, 0.45, 0.01});
  const auto sheet_y = patch->sheet_at({0.45, 0.5, -0.01});
  ASSERT_NE(sheet_x.patch, nullptr);
  ASSERT_NE(sheet_y.patch, nullptr);
  EXPECT_FALSE(sheet_x.is_same(sheet_y));
  EXPECT_EQ(members_of(sheet_x), on_x);
  EXPECT_EQ(members_of(sheet_y), on_y);
  const std::set<std::size_t> all(patch->members.begin(), patch->members.end());
  EXPECT_EQ(all, points_within(points, edge, patch->radius));
}

TEST(PatchFitter, MakesOneSheetOfAWallAwayFromItsEdges) {
  const auto points = test::prism_points(1.0, 0.4, kSpacing, 0.0, 3);
  const auto patch = fitter_of(points).fit({0.5, 0.1, 0.0});
  ASSERT_TRUE(patch);
  EXPECT_TRUE(std::holds_alternative<HeightPatch>(patch->field));
  EXPECT_EQ(members_of(patch->sheet_at(patch->centre)),
            points_within(points, patch->centre, patch->radius));
}

TEST(PatchFitter, SeesNoEdgeInASphere) {
  const auto points = test::sphere_points(0.5, 4000, 0.0, 4);
  const auto fitter = fitter_of(points);
  for (const auto i : {0U, 777U, 2000U, 3999U}) {
    const auto patch = fitter.fit(points[i].position);
    ASSERT_TRUE(patch);
    EXPECT_TRUE(std::holds_alternative<HeightPatch>(patch->field));
  }
}

/// A bowl turned over, which a patch's quadratic is exactly, with noise along z alone, which moves
/// it to neither side. Were the points chosen by their distance in space, those that noise brings
/// nearer would move the patch inwards.
TEST(PatchFitter, LiesOnAverageNeitherInsideNorOutsideABowl) {
  constexpr double kRadius = 0.35;
  constexpr double kSigma = 0.009;
  constexpr int kBowls = 4000;
  test::RandomNumbers random(5);
  double sum = 0.0;
  double squares = 0.0;
  for (int bowl = 0; bowl < kBowls; ++bowl) {
    OrientedPoints points;
    for (int i = 0; i < 400; ++i) {
      const double x = random.uniform(-0.18, 0.18);
      const double y = random.uniform(-0.18, 0.18);
      const double z = -(x * x + y * y) / (2.0 * kRadius);
      points.push_back({{x, y, z + kSigma * random.normal()},
                        Vector3d(x, y, kRadius).normalized(),
                        kSigma * kSigma});
    }
    const auto patch = fitter_of(points).fit(Vector3d::Zero());
    ASSERT_TRUE(patch);
    const double off = patch->at(Vector3d::Zero()).value;
    sum += off;
    squares += off * off;
  }
  constexpr double kSecondOrder = kSigma * kSigma / kRadius;
  EXPECT_LT(std::abs(sum / kBowls), 0.5 * kSecondOrder);
  EXPECT_LT(std::sqrt(squares) / kBowls, 0.2 * kSecondOrder) << "tells too little";
}

/// The patch reaches over the next edges on both sides, the nearer half of its points does not.
TEST(PatchFitter, FindsOneEdgeOfSeveralThatThePatchReachesOver) {
  const Hexagon hexagon{0.08};
  const auto points = hexagon.points(4, 6);
  const auto fitter = fitter_of(points);
  for (const int sixth : {0, 1, 4}) {
    const auto patch = fitter.fit(hexagon.edge(sixth));
    ASSERT_TRUE(patch);
    const auto* creased = std::get_if<CreasedPatch>(&patch->field);
    ASSERT_NE(creased, nullptr);
    EXPECT_NEAR(creased->turn(), std::numbers::pi / 3.0, 0.02);
    for (const double part : {0.1, 0.3, 0.5}) {
      EXPECT_NEAR(patch->at(hexagon.at(sixth, part)).value, 0.0, 1e-6);
      EXPECT_NEAR(patch->at(hexagon.at(sixth - 1, 1.0 - part)).value, 0.0, 1e-6);
    }
  }
}

/// Of the nearest points to a place between columns that are four times as far apart as their
/// points, all lie on four columns or five.
TEST(PatchFitter, ReachesAcrossTheColumnsOfASmoothSurface) {
  constexpr double kRadius = 0.4;
  constexpr int kColumns = 30;
  const double apart = 2.0 * std::numbers::pi * kRadius / kColumns;
  const auto points = cylinder_columns(kRadius, kColumns, apart / 4.0);
  const double angle = 0.4 * 2.0 * std::numbers::pi / kColumns;
  const Vector3d between(kRadius * std::cos(angle), kRadius * std::sin(angle), 0.004);
  const auto patch = fitter_of(points).fit(between);
  ASSERT_TRUE(patch);
  std::set<int> columns;
  for (const auto i : patch->members) {
    const auto& at = points[i].position;
    columns.insert(static_cast<int>(
        std::lround(std::atan2(at.y(), at.x()) * kColumns / (2.0 * std::numbers::pi))));
  }
  EXPECT_GE(columns.size(), 6U);
  EXPECT_LE(patch->members.size(), 60U);
  EXPECT_NEAR(patch->at(between).value, 0.0, 7.5e-5 * kRadius);
}

TEST(PatchFitter, MakesOnePolynomialOfAnExactCrowdOnASmoothSurface) {
  const Vector3d top(0.0, 0.0, 0.5);
  for (const double sigma : {0.0, 1e-3}) {
    const auto points = test::cap_points(top.z(), 0.15, 3000, sigma, 9);
    const auto patch = fitter_of(points).fit(top);
    ASSERT_TRUE(patch);
    EXPECT_EQ(std::holds_alternative<QuinticPatch>(patch->field), sigma == 0.0);
    EXPECT_NEAR(patch->at(top).value, 0.0, sigma == 0.0 ? 1e-7 : 1e-3);
    EXPECT_LT(std::sqrt(patch->variance), 1e-6);
  }
}

TEST(PatchFitter, LeavesOutWhatFacesTheOtherWay) {
  auto points = plane_points(0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    points.push_back({{0.03 * static_cast<double>(i), 0.02, -0.05}, -Vector3d::UnitZ(), 0.0});
  }
  const auto patch = fitter_of(points).fit(Vector3d::Zero());
  ASSERT_TRUE(patch);
  ASSERT_TRUE(std::holds_alternative<HeightPatch>(patch->field));
  for (const auto i : patch->members) EXPECT_GT(points[i].normal.z(), 0.0);
  EXPECT_NEAR(patch->at(Vector3d::Zero()).value, 0.0, 1e-9);
}

TEST(PatchFitter, TakesOneOfPointsThatNearlyCoincide) {
  auto points = plane_points(0.0);
  const std::size_t twin = points.size();
  const auto alone = fitter_of(points).fit(Vector3d::Zero());
  ASSERT_TRUE(alone);
  const std::size_t inner = alone->members[alone->members.size() / 2];
  points.push_back(points[inner]);
  points.back().position.x() += 1e-3 * kSpacing;
  const auto patch = fitter_of(points).fit(Vector3d::Zero());
  ASSERT_TRUE(patch);
  const std::set<std::size_t> members(patch->members.begin(), patch->members.end());
  EXPECT_EQ(members.size(), patch->members.size());
  EXPECT_EQ(members.count(inner) + members.count(twin), 1U);
}

TEST(PatchFitter, MakesNothingOfPointsOnALine) {
  OrientedPoints line;
  for (int i = 0; i < 100; ++i) line.push_back({{0.01 * i, 0, 0}, Vector3d::UnitZ(), 0.0});
  EXPECT_FALSE(fitter_of(line).fit({0.5, 0.0, 0.0}));
}

}  // namespace
}  // namespace instep
