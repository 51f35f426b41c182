#include "core/girth/band/slab_source.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/cylinder_tape.h"

namespace instep {
namespace {

using test::level_plane;

TEST(SlabSource, GivesTheSameSlabsWhateverWasAskedForBefore) {
  const PointCloud cloud = test::cylinder(3000);
  SlabSource source(cloud, level_plane());
  for (const double half_width : {0.1, 0.5, 0.2, 5.0, 5.5, 20.0, 0.1}) {
    const PlaneSlab expected = slab_of(cloud, level_plane(), half_width);
    const PlaneSlab slab = source.slab(half_width);
    EXPECT_EQ(slab.places, expected.places) << half_width;
    EXPECT_EQ(slab.indices, expected.indices) << half_width;
  }
}

TEST(SlabSource, KnowsTheSizeOfTheCloudAsThePlaneSeesIt) {
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

}  // namespace
}  // namespace instep
