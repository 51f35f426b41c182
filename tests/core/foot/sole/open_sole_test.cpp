#include "core/foot/sole/open_sole.h"

#include <gtest/gtest.h>

#include "core/foot/alignment.h"
#include "core/geometry/place_hash.h"
#include "core/geometry/point_spacing.h"
#include "tests/support/foot_body.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Without what lies lower than where its edge bends under.
FootScan without_sole(double length_mm) {
  PointCloud walls;
  for (const auto& point : test::FootBody{length_mm, length_mm / 200.0}.points().positions) {
    if (point.z() > 5.0 * length_mm / 260.0) walls.positions.push_back(point);
  }
  return align_foot(walls).value();
}

std::vector<Vector3d> put_under(const FootScan& foot) {
  std::vector<Vector3d> added;
  for (std::size_t i = 0; i < foot.cloud.size(); ++i) {
    if (!foot.cloud.was_seen(i)) added.push_back(foot.cloud.positions[i]);
  }
  return added;
}

TEST(OpenSole, IsToldFromAClosedOne) {
  EXPECT_GT(put_under(without_sole(260.0)).size(), 1000U);
  EXPECT_TRUE(put_under(align_foot(test::FootBody{}.points()).value()).empty());
}

TEST(OpenSole, IsNoneWhereItsPointsAreFew) {
  const auto points = test::FootBody{}.points();
  for (const std::size_t few : {500U, 700U, 1000U}) {
    FootScan foot;
    foot.cloud = points.subset(some_by_place(points.positions, few));
    foot.landmarks["acropodion"].position_mm = Vector3d(260.0, 0.0, 0.0);
    EXPECT_FALSE(is_sole_open(foot)) << few;
  }
}

/// The doubt of a tape that passes over it counts its points.
TEST(OpenSole, IsClosedByPointsTwoMillimetresApartOnFeetOfEverySize) {
  for (const double length : {130.0, 260.0, 350.0}) {
    const auto foot = without_sole(length);
    EXPECT_FALSE(is_sole_open(foot)) << length;
    const auto added = put_under(foot);
    ASSERT_GT(added.size(), 300U) << length;
    EXPECT_NEAR(median_nearest_distance(PointIndex(added)), 2.0, 0.1) << length;
  }
}

}  // namespace
}  // namespace instep
