#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/oriented_points.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::cylinder;
using test::oblique_plane;
using test::plane_at;

TEST(GirthByRbf, DoesNotDependOnWhereTheBodyStands) {
  const auto cloud = test::random_points(test::elliptic_cylinder(45, 30), 3000, -30, 30, 0.2, 9);
  RigidTransform moved_from_here = RigidTransform::Identity();
  moved_from_here.rotate(Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()));
  moved_from_here.pretranslate(Vector3d(812, -333, 95));
  const auto here = girth_by_rbf(cloud, oblique_plane());
  const auto there = girth_by_rbf(transformed(moved_from_here, cloud),
                                  oblique_plane().transformed(moved_from_here));
  ASSERT_TRUE(here && there);
  EXPECT_NEAR(there->contact_mm, here->contact_mm, 1e-9);
  EXPECT_NEAR(there->stretched_mm, here->stretched_mm, 1e-9);
}

TEST(GirthByRbf, ScalesWithTheUnit) {
  const auto cloud = cylinder(2000, 0.2);
  const auto plane = oblique_plane();
  const auto girth = girth_by_rbf(cloud, plane);
  ASSERT_TRUE(girth);
  for (const double scale : {1e-3, 1e3}) {
    PointCloud scaled = cloud;
    for (auto& position : scaled.positions) position *= scale;
    const auto& c = plane.control_points();
    const auto other = girth_by_rbf(scaled, plane_at(scale * c[0], scale * c[1], scale * c[2]));
    ASSERT_TRUE(other) << other.error().line();
    EXPECT_NEAR(other->contact_mm / scale, girth->contact_mm, 1e-9);
    EXPECT_NEAR(other->stretched_mm / scale, girth->stretched_mm, 1e-9);
    EXPECT_NEAR(other->sigma_mm / scale, girth->sigma_mm, 1e-9);
  }
}

/// So little noise that its square is none.
TEST(GirthByRbf, DoesNotDependOnHowMuchTooLittleNoiseIsTold) {
  const auto cloud = cylinder(3000, 0.2);
  const auto girth = girth_by_rbf(cloud, oblique_plane(), {1e-9});
  const auto of_none = girth_by_rbf(cloud, oblique_plane(), {1e-200});
  ASSERT_TRUE(girth) << girth.error().line();
  ASSERT_TRUE(of_none) << of_none.error().line();
  EXPECT_NEAR(of_none->contact_mm, girth->contact_mm, 1e-4);
  EXPECT_NEAR(of_none->sigma_mm, 0.2, 0.02);
}

TEST(GirthByRbf, DoesNotDependOnTheOrderOfThePoints) {
  auto cloud = cylinder(3000, 0.2);
  const auto girth = girth_by_rbf(cloud, oblique_plane());
  std::reverse(cloud.positions.begin(), cloud.positions.end());
  const auto reversed = girth_by_rbf(cloud, oblique_plane());
  ASSERT_TRUE(girth && reversed);
  EXPECT_NEAR(reversed->contact_mm, girth->contact_mm, 1e-9);
  EXPECT_NEAR(reversed->stretched_mm, girth->stretched_mm, 1e-9);
}

TEST(GirthByRbf, GivesTheSameBytesTwice) {
  const auto cloud = cylinder(3000, 0.3);
  const auto first = girth_by_rbf(cloud, oblique_plane());
  const auto second = girth_by_rbf(cloud, oblique_plane());
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->contact_mm, second->contact_mm);
  EXPECT_EQ(first->contour, second->contour);
}

/// A box whose points stand in a lattice, 1.5 mm apart, and a plane through it, `scale` times as
/// large.
struct LatticeBox {
  PointCloud cloud;
  TapePlane plane;
};

LatticeBox lattice_box(double scale) {
  PointCloud cloud;
  for (const auto& point : test::prism_points(60.0, 80.0, 1.5, 0.0, 1)) {
    cloud.positions.push_back(scale * point.position);
  }
  const Vector3d first(30, 0, 3.4);
  const Vector3d second(0, 30, 0.4);
  const Vector3d third(-30, -10, -2.6);
  return {std::move(cloud),
          TapePlane::through(scale * first, scale * second, scale * third).value()};
}

/// Which of the points that are equally far are among the nearest, rounding decided: girths of one
/// box were up to 0.1 mm apart.
TEST(GirthByRbf, OfALatticeDoesNotDependOnWhereItLies) {
  const LatticeBox box = lattice_box(1.0);
  const auto here = girth_by_rbf(box.cloud, box.plane);
  ASSERT_TRUE(here) << here.error().line();
  for (int turn = 1; turn <= 5; ++turn) {
    RigidTransform away = RigidTransform::Identity();
    away.rotate(Eigen::AngleAxisd(0.7 * turn, Vector3d(0.3 * turn, 1, -0.2).normalized()));
    away.pretranslate(Vector3d(11.3 * turn, -77, 31 * turn));
    const auto there = girth_by_rbf(transformed(away, box.cloud), box.plane.transformed(away));
    ASSERT_TRUE(there) << there.error().line();
    EXPECT_NEAR(there->stretched_mm, here->stretched_mm, 1e-9) << turn;
    EXPECT_NEAR(there->contact_mm, here->contact_mm, 1e-9) << turn;
    EXPECT_NEAR(*there->contact_u95_mm, *here->contact_u95_mm, 1e-8) << turn;
  }
}

TEST(GirthByRbf, OfALatticeDoesNotDependOnItsUnit) {
  const LatticeBox box = lattice_box(1.0);
  const auto here = girth_by_rbf(box.cloud, box.plane);
  ASSERT_TRUE(here) << here.error().line();
  for (const double scale : {10.0, 25.4, 0.1, 1000.0, 1.0 / 3.0}) {
    const LatticeBox scaled = lattice_box(scale);
    const auto there = girth_by_rbf(scaled.cloud, scaled.plane);
    ASSERT_TRUE(there) << there.error().line();
    EXPECT_NEAR(there->stretched_mm / scale, here->stretched_mm, 1e-9) << scale;
    EXPECT_NEAR(there->contact_mm / scale, here->contact_mm, 1e-9) << scale;
    EXPECT_NEAR(*there->contact_u95_mm / scale, *here->contact_u95_mm, 1e-8) << scale;
  }
}

}  // namespace
}  // namespace instep
