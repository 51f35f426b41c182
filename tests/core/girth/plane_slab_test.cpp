#include "core/girth/plane_slab.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "core/geometry/polygon.h"
#include "tests/support/cylinder_tape.h"

namespace instep {
namespace {

using test::level_plane;
using test::plane_at;

TEST(PlaneSlab, HoldsEachPlaceOnceInAnOrderOfItsOwn) {
  PointCloud cloud = test::cylinder(2000);
  const PlaneSlab once = slab_of(cloud, level_plane(), 3.0);
  const auto positions = cloud.positions;
  cloud.positions.insert(cloud.positions.end(), positions.rbegin(), positions.rend());
  const PlaneSlab twice = slab_of(cloud, level_plane(), 3.0);
  EXPECT_EQ(twice.places, once.places);
  EXPECT_EQ(twice.indices, once.indices);
  std::size_t near = 0;
  for (const auto& position : positions)
    if (std::abs(position.z() - 1.3) <= 3.0) ++near;
  EXPECT_EQ(once.places.size(), near);
}

TEST(PlaneSlab, SourceGivesTheSameSlabsWhateverWasAskedForBefore) {
  const PointCloud cloud = test::cylinder(3000);
  SlabSource source(cloud, level_plane());
  for (const double half_width : {0.1, 0.5, 0.2, 5.0, 5.5, 20.0, 0.1}) {
    const PlaneSlab expected = slab_of(cloud, level_plane(), half_width);
    const PlaneSlab slab = source.slab(half_width);
    EXPECT_EQ(slab.places, expected.places) << half_width;
    EXPECT_EQ(slab.indices, expected.indices) << half_width;
  }
}

TEST(PlaneSlab, SourceKnowsTheSizeOfTheCloudAsThePlaneSeesIt) {
  PointCloud cloud;
  for (int corner = 0; corner < 8; ++corner) {
    cloud.positions.emplace_back(7.0 + 2.0 * (corner & 1), 3.0 * (corner >> 1 & 1),
                                 6.0 * (corner >> 2));
  }
  EXPECT_NEAR(SlabSource(cloud, level_plane()).size(), 7.0, 1e-12);
  // Seen along a diagonal the box is wider.
  const auto leaning = TapePlane::through({0, 0, 0}, {1, 1, 0}, {0, 0, 1}).value();
  const double wide = 5.0 / std::sqrt(2.0);
  EXPECT_NEAR(SlabSource(cloud, leaning).size(), std::hypot(wide, wide, 6.0), 1e-12);
}

TEST(PlaneSlab, IsInOrderOfPlacesWhereTheyAreFarFromEven) {
  PointCloud cloud;
  for (int i = 0; i < 400; ++i) {
    const double far = i == 7 ? 5e4 : 0.0;  // nearly all in one strip
    cloud.positions.emplace_back(far + (i * 37 % 5), i * 31 % 400, 1.3 + i % 3);
  }
  const PlaneSlab slab = slab_of(cloud, level_plane(), 3.0);
  ASSERT_EQ(slab.places.size(), cloud.size());
  for (std::size_t i = 1; i < slab.places.size(); ++i) {
    const auto& before = slab.places[i - 1];
    const auto& after = slab.places[i];
    EXPECT_LT(std::tuple(before.x(), before.y(), before.z()),
              std::tuple(after.x(), after.y(), after.z()));
  }
}

TEST(PlaneSlab, IsCutWherePointsLieBeyondThePlane) {
  const PointCloud cloud = test::cylinder(4000);
  EXPECT_TRUE(is_cut(slab_of(cloud, level_plane(), 3.0).places));
  EXPECT_TRUE(is_cut(slab_of(cloud, level_plane(29.5), 3.0).places));
  EXPECT_FALSE(is_cut(slab_of(cloud, level_plane(30.0), 3.0).places));
  EXPECT_FALSE(is_cut(slab_of(cloud, plane_at({40, 0, 0}, {40, 1, 0}, {40, 0, 1}), 3.0).places));
  // A row of points on the plane is cut by it.
  EXPECT_TRUE(is_cut(slab_of(test::rings(60, 3, 2.0), level_plane(0.0), 3.0).places));
}

TEST(PlaneSlab, TapeRoundIsThePerimeterOfTheHull) {
  const PointCloud cloud = test::cylinder(4000);
  for (const auto& plane :
       {level_plane(), test::oblique_plane(), plane_at({0, 0, 0}, {0, 1, 0}, {0, 0, 1})}) {
    for (const double half_width : {1.0, 5.0, 100.0}) {
      const double hull = perimeter(hull_of(slab_of(cloud, plane, half_width)));
      EXPECT_NEAR(tape_round(cloud, plane, half_width), hull, 0.01 * hull);
    }
  }
  EXPECT_EQ(tape_round(cloud, level_plane(500.0), 10.0), 0.0);
}

}  // namespace
}  // namespace instep
