#include "core/girth/band/plane_slab.h"

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
