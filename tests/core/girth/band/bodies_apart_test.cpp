#include "core/girth/band/bodies_apart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using test::kCylinderRadius;
using test::oblique_plane;
using test::RandomNumbers;

constexpr std::size_t kOfCylinder = 6000;

/// Beside the cylinder, on the side of the first axis.
void add_wall(std::size_t count, double apart_mm, PointCloud& cloud) {
  RandomNumbers random(2);
  for (std::size_t i = 0; i < count; ++i) {
    cloud.positions.emplace_back(kCylinderRadius + apart_mm, random.uniform(-90.0, 90.0),
                                 random.uniform(-30.0, 30.0));
  }
}

/// Round its foot: the cylinder stands on it.
void add_floor(std::size_t count, double below_mm, PointCloud& cloud) {
  RandomNumbers random(3);
  for (std::size_t i = 0; i < count; ++i) {
    cloud.positions.emplace_back(random.uniform(-120.0, 120.0), random.uniform(-120.0, 120.0),
                                 -below_mm);
  }
}

/// All that there are.
class All : public BodiesLook {
 public:
  bool may_count(const BodyApart&) const override { return true; }
  bool look_at(const BodyApart& body) override {
    bodies.push_back(body);
    return true;
  }
  void pass_over(const BodyApart&) override {}
  bool is_settled() const override { return false; }

  std::vector<BodyApart> bodies;
};

std::vector<BodyApart> bodies_of(const PointCloud& cloud, const TapePlane& plane) {
  All all;
  look_at_bodies_apart(cloud, plane, all);
  return all.bodies;
}

/// The largest that has points of the cylinder alone: how many. `others`: from which number on
/// points are not the cylinder's.
std::size_t most_of_cylinder(const PointCloud& cloud, std::size_t others) {
  std::size_t most = 0;
  for (const auto& body : bodies_of(cloud, oblique_plane())) {
    if (body.points.back() < others) most = std::max(most, body.points.size());
  }
  return most;
}

TEST(BodiesApart, AreNoneOfOneBody) {
  for (const double sigma : {0.0, 0.5}) {
    for (const std::size_t count : {400U, 6000U, 100000U}) {
      EXPECT_TRUE(bodies_of(test::cylinder(count, sigma), oblique_plane()).empty());
    }
  }
}

TEST(BodiesApart, PartABodyFromAWall) {
  for (const double apart_mm : {8.0, 30.0}) {
    PointCloud cloud = test::cylinder(kOfCylinder);
    add_wall(3000, apart_mm, cloud);
    EXPECT_GT(most_of_cylinder(cloud, kOfCylinder), kOfCylinder / 2);
  }
}

/// Where it stands on it only thin slabs are apart.
TEST(BodiesApart, PartABodyFromWhatItStandsOn) {
  PointCloud cloud = test::cylinder(kOfCylinder);
  add_floor(8000, 30.0, cloud);
  EXPECT_GT(most_of_cylinder(cloud, kOfCylinder), kOfCylinder / 10);
}

TEST(BodiesApart, LeaveOutStrays) {
  PointCloud cloud = test::cylinder(kOfCylinder);
  RandomNumbers random(4);
  for (int i = 0; i < 200; ++i) {
    cloud.positions.emplace_back(random.uniform(60.0, 200.0), random.uniform(-100.0, 100.0),
                                 random.uniform(-30.0, 30.0));
  }
  EXPECT_GT(most_of_cylinder(cloud, kOfCylinder), kOfCylinder / 2);
}

/// As two feet are, with as many points each.
PointCloud two_cylinders() {
  PointCloud cloud = test::cylinder(kOfCylinder);
  PointCloud other =
      test::random_points(test::elliptic_cylinder(20.0, 15.0), kOfCylinder, -30.0, 30.0, 0.0, 6);
  for (auto& position : other.positions) position.x() += 90.0;
  cloud.append(other);
  return cloud;
}

TEST(BodiesApart, ComeInTheOrderOfWhatATapeEncloses) {
  const auto bodies = bodies_of(two_cylinders(), test::level_plane());
  ASSERT_GE(bodies.size(), 2U);
  const auto& larger = bodies[0];
  const auto& smaller = bodies[1];
  EXPECT_EQ(larger.points.front(), 0U);
  EXPECT_LT(larger.points.back(), kOfCylinder);
  EXPECT_GE(smaller.points.front(), kOfCylinder);
  EXPECT_NEAR(larger.area, std::numbers::pi * 40.0 * 40.0, 0.02 * larger.area);
  EXPECT_NEAR(smaller.area, std::numbers::pi * 20.0 * 15.0, 0.02 * smaller.area);
  for (const auto& body : bodies) {
    EXPECT_TRUE(std::is_sorted(body.points.begin(), body.points.end()));
  }
}

/// Where the first of a way is enough the other one comes in the next, and no thinner slab after
/// it.
TEST(BodiesApart, AreNotShownWhenEnoughIsSeen) {
  class First : public All {
   public:
    bool look_at(const BodyApart& body) override {
      All::look_at(body);
      return false;
    }
    bool is_settled() const override { return !bodies.empty(); }
  };
  First first;
  look_at_bodies_apart(two_cylinders(), test::level_plane(), first);
  ASSERT_EQ(first.bodies.size(), 2U);
  EXPECT_LT(first.bodies[0].points.back(), kOfCylinder);
  EXPECT_GE(first.bodies[1].points.front(), kOfCylinder);
}

TEST(BodiesApart, AreTheSameInAnotherUnit) {
  PointCloud cloud = test::cylinder(kOfCylinder, 0.2);
  add_wall(3000, 8.0, cloud);
  add_floor(4000, 30.0, cloud);
  const auto bodies = bodies_of(cloud, oblique_plane());
  for (auto& position : cloud.positions) position *= 0.1;
  const auto plane = oblique_plane();
  const auto& [first, second, third] = plane.control_points();
  const auto tenths = bodies_of(cloud, test::plane_at(0.1 * first, 0.1 * second, 0.1 * third));
  ASSERT_FALSE(bodies.empty());
  ASSERT_EQ(bodies.size(), tenths.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    EXPECT_EQ(bodies[i].points, tenths[i].points);
  }
}

TEST(BodiesApart, AreNoneWhereThePlaneMisses) {
  EXPECT_TRUE(bodies_of(test::cylinder(kOfCylinder), test::level_plane(500.0)).empty());
  EXPECT_TRUE(bodies_of({}, test::level_plane()).empty());
}

}  // namespace
}  // namespace instep
