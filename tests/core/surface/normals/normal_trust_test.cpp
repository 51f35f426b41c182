#include "core/surface/normals/normal_trust.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "tests/support/analytic_shapes.h"
#include "tests/support/oriented_points.h"
#include "tests/support/prism_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Normals = std::vector<Vector3d>;

constexpr std::size_t kSparse = 300;
constexpr std::size_t kDense = 8000;

/// Points of a body and their true normals.
struct Body {
  std::string name;
  PointIndex index;
  Normals normals;

  NormalTrust trust(const Normals& told) const { return trust_in(told, index); }
};

Body body_of(std::string name, const test::AnalyticShape& shape, std::size_t count,
             std::uint64_t seed) {
  auto cloud = test::points_by_area(shape, count, -30, 30, seed);
  return {std::move(name) + " of " + std::to_string(count) + ", seed " + std::to_string(seed),
          PointIndex(std::move(cloud.positions)), std::move(cloud.normals)};
}

Body creased(std::size_t count, std::uint64_t seed) {
  return body_of("creased", test::flat_soled_cylinder(45, 35, 20), count, seed);
}

std::vector<Body> bodies(std::size_t count, std::uint64_t seed) {
  std::vector<Body> bodies;
  bodies.push_back(body_of("cylinder", test::elliptic_cylinder(40, 40), count, seed));
  bodies.push_back(body_of("ellipse", test::elliptic_cylinder(48, 28), count, seed));
  bodies.push_back(body_of("lobed", test::lobed_cylinder(40, 6, 3), count, seed));
  bodies.push_back(body_of("cone", test::cone(38, 0.25), count, seed));
  bodies.push_back(body_of("many lobes", test::lobed_cylinder(40, 5, 6), count, seed));
  bodies.push_back(creased(count, seed));
  return bodies;
}

std::vector<Body> all_bodies() {
  std::vector<Body> all;
  for (const std::size_t count : {kSparse, kDense}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      for (auto& body : bodies(count, seed)) all.push_back(std::move(body));
    }
  }
  return all;
}

Vector3d random_direction(test::RandomNumbers& random) {
  return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

/// Tilted in two directions by a standard deviation of so much.
Normals with_noise(Normals normals, double degrees, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  const double spread = degrees * std::numbers::pi / 180.0;
  for (auto& normal : normals) {
    const Vector3d along = normal.unitOrthogonal();
    const double tilt = spread * random.normal();
    normal += tilt * along + spread * random.normal() * normal.cross(along);
    normal.normalize();
  }
  return normals;
}

Normals averaged(const Body& body, std::size_t neighbours) {
  Normals normals;
  for (const auto& place : body.index.points()) {
    Vector3d sum = Vector3d::Zero();
    for (const auto& near : body.index.nearest(place, neighbours)) sum += body.normals[near.index];
    normals.push_back(sum.normalized());
  }
  return normals;
}

Normals flipped(Normals normals, double share, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  for (auto& normal : normals) {
    if (random.uniform() < share) normal *= -1.0;
  }
  return normals;
}

TEST(NormalTrust, RightNormalsTellSlopes) {
  for (const auto& body : all_bodies()) {
    EXPECT_EQ(body.trust(body.normals), NormalTrust::kSlopes) << body.name;
  }
}

/// The nearest neighbours of some points beside a crease all lie on its other side.
TEST(NormalTrust, RightNormalsOfFewPointsBesideACreaseTellSlopes) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Body body = creased(kSparse, seed);
    EXPECT_EQ(body.trust(body.normals), NormalTrust::kSlopes) << body.name;
  }
}

TEST(NormalTrust, NormalsOfAPrismOnAGridTellSlopes) {
  const auto points = test::prism_points(60.0, 40.0, 3.0, 0.0, 1);
  Normals normals;
  for (const auto& point : points) normals.push_back(point.normal);
  const PointIndex index(test::positions_of(points));
  EXPECT_NE(trust_in(normals, index), NormalTrust::kNone);
}

TEST(NormalTrust, NoisyNormalsTellTheSideOnly) {
  for (const auto& body : all_bodies()) {
    EXPECT_EQ(body.trust(with_noise(body.normals, 5.0, 4)), NormalTrust::kSide) << body.name;
  }
}

TEST(NormalTrust, NormalsAveragedOverACreaseTellTheSideOnly) {
  for (const std::size_t count : {kSparse, std::size_t{1200}, kDense}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const Body body = creased(count, seed);
      EXPECT_EQ(body.trust(averaged(body, 8)), NormalTrust::kSide) << body.name;
    }
  }
}

TEST(NormalTrust, NormalsOfWhichOneInTwentyIsFarOffTellTheSideOnly) {
  for (const auto& body : all_bodies()) {
    test::RandomNumbers random(9);
    Normals normals = body.normals;
    for (auto& normal : normals) {
      if (random.uniform() > 0.05) continue;
      const Vector3d aside = normal.cross(random_direction(random)).normalized();
      normal = (normal + 0.8 * aside).normalized();
    }
    EXPECT_EQ(body.trust(normals), NormalTrust::kSide) << body.name;
  }
}

TEST(NormalTrust, NormalsAtRandomOnATenthOfTheSectionTellNothing) {
  for (const auto& body : all_bodies()) {
    test::RandomNumbers random(10);
    Normals normals = body.normals;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Vector3d& place = body.index.points()[i];
      if (std::abs(std::atan2(place.y(), place.x())) > 0.1 * std::numbers::pi) continue;
      normals[i] = random_direction(random);
    }
    EXPECT_EQ(body.trust(normals), NormalTrust::kNone) << body.name;
  }
}

TEST(NormalTrust, NormalsAtRandomTellNothing) {
  for (const auto& body : all_bodies()) {
    test::RandomNumbers random(5);
    Normals normals;
    for (std::size_t i = 0; i < body.normals.size(); ++i) {
      normals.push_back(random_direction(random));
    }
    EXPECT_EQ(body.trust(normals), NormalTrust::kNone) << body.name;
  }
}

TEST(NormalTrust, NormalsOfWhichSomeAreFlippedTellNothing) {
  for (const auto& body : all_bodies()) {
    for (const double share : {0.1, 0.5, 0.9}) {
      EXPECT_EQ(body.trust(flipped(body.normals, share, 6)), NormalTrust::kNone)
          << body.name << ", " << share;
    }
  }
}

/// Within so far of a point of the section.
Normals turned_over_near(const Body& body, std::size_t point, double reach) {
  Normals normals = body.normals;
  for (const auto& near : body.index.around(body.index.points()[point], reach)) {
    normals[near.index] *= -1.0;
  }
  return normals;
}

TEST(NormalTrust, NormalsOfWhichAPatchIsTurnedOverTellNothing) {
  for (const auto& body : all_bodies()) {
    for (const std::size_t point : {0U, 17U, 101U}) {
      for (const double reach : {12.0, 20.0}) {
        EXPECT_EQ(body.trust(turned_over_near(body, point, reach)), NormalTrust::kNone)
            << body.name << ", " << reach << " mm round " << point;
      }
    }
  }
}

TEST(LoneNormals, AreRightedAndNoOthers) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    for (const Body& body : {body_of("ellipse", test::elliptic_cylinder(48, 28), 1500, seed),
                             body_of("cone", test::cone(38, 0.25), 1500, seed)}) {
      Normals normals = body.normals;
      EXPECT_FALSE(right_lone_normals(normals, body.index)) << body.name;
      for (const std::size_t lone : {100U, 300U, 900U}) normals[lone] *= -1.0;
      EXPECT_TRUE(right_lone_normals(normals, body.index)) << body.name;
      for (std::size_t i = 0; i < normals.size(); ++i) {
        const double cosine = normals[i].dot(body.normals[i]);
        EXPECT_GT(cosine, i == 100 || i == 300 || i == 900 ? 0.95 : 1.0 - 1e-12) << body.name;
      }
    }
  }
}

TEST(LoneNormals, OfAPatchStayAsTheyAre) {
  for (const auto& body : all_bodies()) {
    const Normals turned = turned_over_near(body, 17, 20.0);
    Normals normals = turned;
    right_lone_normals(normals, body.index);
    EXPECT_EQ(trust_in(normals, body.index), NormalTrust::kNone) << body.name;
  }
}

/// Their two sides face opposite ways, but across the skin.
TEST(NormalTrust, RightNormalsOfAThinBodyTellSlopes) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Body thin = body_of("thin", test::elliptic_cylinder(40, 3), 6000, seed);
    EXPECT_EQ(thin.trust(thin.normals), NormalTrust::kSlopes) << thin.name;
  }
}

TEST(NormalTrust, NormalsThatPointInwardsTellNothing) {
  for (const auto& body : all_bodies()) {
    EXPECT_EQ(body.trust(flipped(body.normals, 1.1, 7)), NormalTrust::kNone) << body.name;
  }
}

const Vector3d kWays[] = {{1, 0, 0}, {0.6, -0.8, 0}, {0, 0, 1}, {0, 0, -1}, {0.1, 0, 1}};

TEST(NormalTrust, NormalsThatAreAllAlikeTellNothing) {
  for (const auto& body : all_bodies()) {
    for (const Vector3d& way : kWays) {
      const Normals normals(body.normals.size(), way.normalized());
      EXPECT_EQ(body.trust(normals), NormalTrust::kNone) << body.name << ": " << way.transpose();
    }
  }
}

TEST(NormalTrust, NormalsThatAreNearlyAlikeTellNothing) {
  for (const auto& body : all_bodies()) {
    for (const Vector3d& way : kWays) {
      const Normals normals(body.normals.size(), way.normalized());
      EXPECT_EQ(body.trust(with_noise(normals, 2.0, 8)), NormalTrust::kNone)
          << body.name << ": " << way.transpose();
    }
  }
}

/// Those of the two walls face away from each other, back to back: they were dropped.
TEST(NormalTrust, IsInThoseOfThinParts) {
  for (const double degrees : {30.0, 45.0}) {
    for (const int count : {500, 2000}) {
      const auto cloud = test::faced_prism_points(test::rhombus(degrees, 60.0), count, 1);
      EXPECT_NE(trust_in(cloud.normals, PointIndex(cloud.positions)), NormalTrust::kNone)
          << degrees << " " << count;
    }
  }
}

}  // namespace
}  // namespace instep
