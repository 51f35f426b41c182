#include "core/girth/section/section_loops.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

/// The loops of a cloud at the level plane, with the band that they are in.
struct Traced {
  PlaneBand band;
  std::vector<SectionLoop> loops;

  double length_mm(std::size_t loop) const { return band.unit_mm * loops[loop].contour.length(); }
  double unexplained() const {
    const auto& first = loops.front();
    return unexplained_share(band, loops, evidence_for(band, first.index, evidence_reach(band)));
  }
};

Traced traced(const PointCloud& cloud) {
  SlabSource slabs(cloud, test::level_plane());
  auto band = band_at(slabs);
  BlendedSurface surface(PatchFitter(band->points, std::move(band->index), band->roughness));
  auto loops = loops_on(*band, surface);
  return {std::move(*band), std::move(loops)};
}

/// Round the z axis moved along x.
void add_pole(double radius, double x, std::size_t count, PointCloud& cloud) {
  PointCloud pole =
      test::random_points(test::elliptic_cylinder(radius, radius), count, -30.0, 30.0, 0.0, 7);
  for (auto& position : pole.positions) position.x() += x;
  cloud.append(pole);
}

TEST(SectionLoops, AreOneOfOneBody) {
  const auto one = traced(test::cylinder(8000));
  ASSERT_EQ(one.loops.size(), 1U);
  EXPECT_NEAR(one.length_mm(0), test::kCylinderGirth, 0.01);
  EXPECT_EQ(one.unexplained(), 0.0);
}

TEST(SectionLoops, BeginWithTheLargest) {
  PointCloud cloud;
  add_pole(15.0, 80.0, 3000, cloud);
  cloud.append(test::cylinder(8000));
  const auto two = traced(cloud);
  ASSERT_EQ(two.loops.size(), 2U);
  EXPECT_NEAR(two.length_mm(0), test::kCylinderGirth, 0.01);
  EXPECT_NEAR(two.length_mm(1), 2.0 * std::numbers::pi * 15.0, 0.01);
  EXPECT_LT(two.unexplained(), 0.001);
}

/// A third of the points near the plane are of a wall, which closes nowhere.
TEST(SectionLoops, LeaveSheetsUnexplained) {
  PointCloud cloud = test::cylinder(6000);
  test::RandomNumbers random(3);
  for (int i = 0; i < 3000; ++i) {
    cloud.positions.emplace_back(random.uniform(-60.0, 60.0), 75.0, random.uniform(-30.0, 30.0));
  }
  const auto beside = traced(cloud);
  ASSERT_EQ(beside.loops.size(), 1U);
  EXPECT_NEAR(beside.unexplained(), 1.0 / 3.0, 0.05);
}

/// Without what lies behind a plane across the x axis, nothing closes round the larger one.
PointCloud half_of(PointCloud cloud, double least_x) {
  std::erase_if(cloud.positions, [&](const auto& position) { return position.x() < least_x; });
  return cloud;
}

TEST(SectionLoops, HaveALargerOneBesideThatDoesNotClose) {
  PointCloud cloud = half_of(test::cylinder(8000), -10.0);
  add_pole(15.0, 80.0, 3000, cloud);
  const auto pole = traced(cloud);
  ASSERT_EQ(pole.loops.size(), 1U);
  EXPECT_NEAR(pole.length_mm(0), 2.0 * std::numbers::pi * 15.0, 0.05);
  EXPECT_TRUE(has_larger_beside(pole.band, pole.loops));
}

/// Nor is a wall one, however many points it has, nor what goes round the section.
TEST(SectionLoops, HaveNoLargerOneBeside) {
  const auto alone = traced(test::cylinder(8000));
  EXPECT_FALSE(has_larger_beside(alone.band, alone.loops));
  PointCloud beside_wall = test::cylinder(8000);
  test::RandomNumbers random(3);
  for (int i = 0; i < 20000; ++i) {
    beside_wall.positions.emplace_back(-60.0, random.uniform(-150.0, 150.0),
                                       random.uniform(-30.0, 30.0));
  }
  const auto one = traced(beside_wall);
  ASSERT_EQ(one.loops.size(), 1U);
  EXPECT_FALSE(has_larger_beside(one.band, one.loops));
  // The noise of a long wall covers as much as the body does.
  PointCloud beside_noisy = test::cylinder(8000);
  for (int i = 0; i < 6000; ++i) {
    beside_noisy.positions.emplace_back(-60.0 + 1.5 * random.normal(),
                                        random.uniform(-300.0, 300.0), random.uniform(-30.0, 30.0));
  }
  const auto noisy = traced(beside_noisy);
  ASSERT_EQ(noisy.loops.size(), 1U);
  EXPECT_FALSE(has_larger_beside(noisy.band, noisy.loops));

  PointCloud in_shell;
  add_pole(15.0, 0.0, 3000, in_shell);
  for (const double side : {-1.0, 1.0}) {
    PointCloud half = half_of(test::cylinder(8000), 32.0);
    for (auto& position : half.positions) position.head<2>() *= side;
    in_shell.append(half);
  }
  const auto inner = traced(in_shell);
  ASSERT_EQ(inner.loops.size(), 1U);
  EXPECT_FALSE(has_larger_beside(inner.band, inner.loops));
}

}  // namespace
}  // namespace instep
