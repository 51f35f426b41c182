#include "core/surface/paper/off_surface_points.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

TEST(OffSurfacePoints, LieOutsideByTheDistanceThatIsTheirValue) {
  const Points points = {{0, 0, 0}, {1, 2, 3}};
  const Points normals = {{0, 0, 1}, {0.6, 0.8, 0}};
  const auto samples = with_off_surface_points(points, normals, 0.5);
  EXPECT_EQ(samples.positions, (Points{{0, 0, 0}, {1, 2, 3}, {0, 0, 0.5}, {1.3, 2.4, 3}}));
  EXPECT_EQ(samples.values, (std::vector<double>{0, 0, -0.5, -0.5}));
}

}  // namespace
}  // namespace instep
