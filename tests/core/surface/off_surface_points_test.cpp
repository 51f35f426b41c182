#include "core/surface/off_surface_points.h"

#include <gtest/gtest.h>

#include "tests/support/random_numbers.h"

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

TEST(OffSurfacePoints, NearDuplicatesAreLeftOut) {
  test::RandomNumbers random(2);
  Points points;
  for (int i = 0; i < 500; ++i) {
    points.emplace_back(random.uniform(0, 10), random.uniform(0, 10), random.uniform(0, 10));
    if (i % 5 == 0) points.push_back(points.back());
    if (i % 7 == 0) points.push_back(points.back() + Vector3d(1e-5, 0, 0));
  }
  const auto kept = without_near_duplicates(points, 0.3);
  for (std::size_t a = 0; a < kept.size(); ++a) {
    for (std::size_t b = a + 1; b < kept.size(); ++b) EXPECT_GT((kept[a] - kept[b]).norm(), 0.3);
  }
  for (const auto& point : points) {
    double nearest = 1e9;
    for (const auto& other : kept) nearest = std::min(nearest, (point - other).norm());
    EXPECT_LE(nearest, 0.3 + 1e-12);
  }
  EXPECT_EQ(without_near_duplicates(points, 0.0).size(), 500U + 72U);
  EXPECT_TRUE(without_near_duplicates({}, 1.0).empty());
}

}  // namespace
}  // namespace instep
