#include "core/girth/section_loops.h"

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

}  // namespace
}  // namespace instep
