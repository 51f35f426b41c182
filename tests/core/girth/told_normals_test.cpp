#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/geometry/point_index.h"
#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cases/case_bodies.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::oblique_plane;

constexpr std::uint64_t kSeeds = 24;

/// An elliptic cylinder cut flat, with two sharp edges, as points at random and their true normals.
struct Creased {
  PointCloud cloud;
  TapePlane plane;
  double stretched_mm;
};

Creased creased(std::uint64_t seed) {
  const auto body = test::creased_body(seed);
  test::RandomNumbers random(100 + seed);
  const TapePlane plane = body.plane(random);
  return {body.crowd(900 + 100 * (seed % 7), seed), plane, body.lengths(plane)->stretched_mm};
}

PointCloud bare(PointCloud cloud) {
  cloud.normals.clear();
  return cloud;
}

bool are_dropped(const Girth& girth) {
  return std::any_of(girth.warnings.begin(), girth.warnings.end(), [](const auto& warning) {
    return warning.find("normals") != std::string::npos &&
           warning.find("leave them out of the file") != std::string::npos;
  });
}

/// Errors of many girths.
struct Errors {
  double mean_mm = 0.0;
  int held = 0;  ///< by their intervals
};

template <class Normals>
Errors errors_with(const Normals& normals) {
  Errors errors;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    auto [cloud, plane, truth] = creased(seed);
    cloud.normals = normals(cloud);
    const auto girth = girth_by_rbf(cloud, plane);
    EXPECT_TRUE(girth) << girth.error().line();
    if (!girth) continue;
    EXPECT_FALSE(are_dropped(*girth)) << seed;
    const double off = std::abs(girth->stretched_mm - truth);
    errors.mean_mm += off / static_cast<double>(kSeeds);
    EXPECT_TRUE(girth->stretched_u95_mm);
    if (off <= girth->stretched_u95_mm.value()) ++errors.held;
  }
  return errors;
}

std::vector<Vector3d> averaged(const PointCloud& cloud, std::size_t neighbours) {
  const PointIndex index(cloud.positions);
  std::vector<Vector3d> normals;
  for (const auto& place : cloud.positions) {
    Vector3d sum = Vector3d::Zero();
    for (const auto& near : index.nearest(place, neighbours)) sum += cloud.normals[near.index];
    normals.push_back(sum.normalized());
  }
  return normals;
}

// Measured: 0.016 and 0.035 mm.
TEST(ToldNormals, BringACreasedGirthNearerToTheTruth) {
  const auto told = errors_with([](const PointCloud& cloud) { return cloud.normals; });
  const auto none = errors_with([](const PointCloud&) { return std::vector<Vector3d>{}; });
  EXPECT_LT(told.mean_mm, 0.6 * none.mean_mm) << none.mean_mm;
  EXPECT_EQ(told.held, static_cast<int>(kSeeds));
}

/// They look right but bend round the edges.
TEST(ToldNormals, ThatWereSmoothedSpoilNothing) {
  const auto smoothed = errors_with([](const PointCloud& cloud) { return averaged(cloud, 8); });
  const auto none = errors_with([](const PointCloud&) { return std::vector<Vector3d>{}; });
  EXPECT_LT(smoothed.mean_mm, 1.3 * none.mean_mm) << none.mean_mm;
  EXPECT_GE(smoothed.held, none.held - 1);
}

template <class Spoil>
void expect_unused(const char* name, const Spoil& spoil) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    auto [cloud, plane, truth] = creased(seed);
    test::RandomNumbers random(seed);
    for (auto& normal : cloud.normals) normal = spoil(normal, random);
    for (const TapePlane& one : {plane, test::level_plane()}) {
      const auto spoilt = girth_by_rbf(cloud, one);
      const auto without = girth_by_rbf(bare(cloud), one);
      ASSERT_TRUE(spoilt && without) << name;
      EXPECT_NEAR(spoilt->stretched_mm, without->stretched_mm, 1e-9) << name << " " << seed;
      EXPECT_NEAR(spoilt->contact_mm, without->contact_mm, 1e-9) << name << " " << seed;
      EXPECT_TRUE(are_dropped(*spoilt)) << name << " " << seed;
      EXPECT_FALSE(are_dropped(*without)) << name << " " << seed;
    }
  }
}

TEST(ToldNormals, ThatContradictEachOtherAreNotUsedAndThatIsSaid) {
  expect_unused("random", [](const Vector3d&, test::RandomNumbers& random) {
    return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  });
  expect_unused("flipped", [](const Vector3d& normal, test::RandomNumbers& random) {
    return Vector3d(random.uniform() < 0.1 ? -normal : normal);
  });
}

TEST(ToldNormals, ThatPointInwardsAreNotUsedAndThatIsSaid) {
  expect_unused("inward",
                [](const Vector3d& normal, test::RandomNumbers&) { return Vector3d(-normal); });
}

/// They agree among each other, but no section closes over where they turn over.
TEST(ToldNormals, OfWhichOneStretchPointsInwardsAreNotUsedAndThatIsSaid) {
  expect_unused("one stretch", [](const Vector3d& normal, test::RandomNumbers&) {
    return Vector3d(normal.x() > 0.8 ? -normal : normal);
  });
}

/// Feet of 1,500 points of which one in fifty was turned over were up to 15 mm too long, one in
/// three unseen.
TEST(ToldNormals, OfWhichAFewAreTurnedOverAreNotUsedAndThatIsSaid) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    auto [cloud, plane, truth] = creased(seed);
    const PointIndex index(cloud.positions);
    const Vector3d place = plane.origin() + 45.0 * plane.u();
    for (const auto& near : index.nearest(place, 3 + seed)) cloud.normals[near.index] *= -1.0;
    const auto spoilt = girth_by_rbf(cloud, plane);
    const auto without = girth_by_rbf(bare(cloud), plane);
    ASSERT_TRUE(spoilt && without) << seed;
    EXPECT_NEAR(spoilt->stretched_mm, without->stretched_mm, 1e-9) << seed;
    EXPECT_TRUE(are_dropped(*spoilt)) << seed;
  }
}

/// Of a sparse cloud it could dent the skin by millimetres.
TEST(ToldNormals, OfWhichOneIsTurnedOverSpoilNothing) {
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    auto [cloud, plane, truth] = creased(seed);
    const PointIndex index(cloud.positions);
    const Vector3d place = plane.origin() + 45.0 * plane.u();
    cloud.normals[index.nearest(place, 1).front().index] *= -1.0;
    const auto girth = girth_by_rbf(cloud, plane);
    ASSERT_TRUE(girth) << seed;
    const double off = std::abs(girth->stretched_mm - truth);
    EXPECT_LT(off, 0.6) << seed;
    if (off <= *girth->stretched_u95_mm) ++held;
  }
  EXPECT_GE(held, 11);
}

TEST(ToldNormals, ThatAreAllAlikeAreNotUsedAndThatIsSaid) {
  expect_unused("up", [](const Vector3d&, test::RandomNumbers&) { return Vector3d(0, 0, 1); });
  expect_unused("aside", [](const Vector3d&, test::RandomNumbers&) { return Vector3d(1, 0, 0); });
}

TEST(ToldNormals, ThatAreNotUsedAreNamedByAMeshTooWithTheRemedy) {
  auto [cloud, plane, truth] = creased(1);
  const auto right = girth_by_mesh(cloud, plane);
  for (auto& normal : cloud.normals) normal = Vector3d(-normal);
  const auto inward = girth_by_mesh(cloud, plane);
  ASSERT_TRUE(right && inward);
  EXPECT_FALSE(are_dropped(*right));
  EXPECT_TRUE(are_dropped(*inward));
}

TEST(ToldNormals, GiveTheSameWhereverTheBodyStands) {
  RigidTransform motion = RigidTransform::Identity();
  motion.rotate(Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()));
  motion.pretranslate(Vector3d(812, -333, 95));
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto [cloud, plane, truth] = creased(seed);
    const auto here = girth_by_rbf(cloud, plane);
    const auto there = girth_by_rbf(transformed(motion, cloud), plane.transformed(motion));
    ASSERT_TRUE(here && there);
    EXPECT_NEAR(there->contact_mm, here->contact_mm, 1e-3) << seed;
    EXPECT_NEAR(there->stretched_mm, here->stretched_mm, 1e-3) << seed;
  }
}

TEST(ToldNormals, GiveTheSameInAnyOrder) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    auto [cloud, plane, truth] = creased(seed);
    const auto girth = girth_by_rbf(cloud, plane);
    std::reverse(cloud.positions.begin(), cloud.positions.end());
    std::reverse(cloud.normals.begin(), cloud.normals.end());
    const auto reversed = girth_by_rbf(cloud, plane);
    ASSERT_TRUE(girth && reversed);
    EXPECT_NEAR(reversed->contact_mm, girth->contact_mm, 1e-9) << seed;
    EXPECT_NEAR(reversed->stretched_mm, girth->stretched_mm, 1e-9) << seed;
  }
}

/// Points that are off by more than their normals could tell count as they did.
TEST(ToldNormals, OfNoisyPointsTellTheSideOnly) {
  const auto shape = test::elliptic_cylinder(45, 30);
  auto cloud = test::points_by_area(shape, 3000, -30, 30, 1);
  test::RandomNumbers random(2);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.positions[i] += 0.2 * random.normal() * cloud.normals[i];
  }
  const auto told = girth_by_rbf(cloud, oblique_plane());
  ASSERT_TRUE(told) << told.error().line();
  EXPECT_FALSE(are_dropped(*told));
  EXPECT_NEAR(told->stretched_mm, test::true_girth(shape, oblique_plane()), 0.12);
}

}  // namespace
}  // namespace instep
