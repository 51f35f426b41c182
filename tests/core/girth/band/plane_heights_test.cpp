#include "core/girth/band/plane_heights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/cylinder_tape.h"

namespace instep {
namespace {

using test::level_plane;

TEST(PlaneHeights, TellAllPointsWithinAWidthAndNoneFarOff) {
  const PointCloud cloud = test::cylinder(2003);
  const TapePlane plane = level_plane();
  const PlaneHeights heights(cloud, plane);
  for (const double half_width : {0.0, 1e-3, 2.0, std::abs(plane.distance(cloud.positions[99]))}) {
    std::vector<std::size_t> least;
    std::vector<std::size_t> most;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double height = std::abs(plane.distance(cloud.positions[i]));
      if (height <= half_width) least.push_back(i);
      if (height <= 1.00001 * half_width + 1e-30) most.push_back(i);
    }
    const auto found = heights.about(half_width);
    EXPECT_TRUE(std::includes(found.begin(), found.end(), least.begin(), least.end()));
    EXPECT_TRUE(std::includes(most.begin(), most.end(), found.begin(), found.end()));
  }
}

TEST(PlaneHeights, TellTheSizeOfAnyNumberOfPoints) {
  EXPECT_EQ(PlaneHeights({}, level_plane()).size(), 0.0);
  PointCloud cloud;
  for (int i = 0; i < 9; ++i) {
    cloud.positions.emplace_back(3.0 * i, 4.0 * i, 12.0 * i);
    EXPECT_NEAR(PlaneHeights(cloud, level_plane()).size(), 13.0 * i, 1e-12);
  }
}

}  // namespace
}  // namespace instep
