#include "core/geometry/point_cloud.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace instep {
namespace {

using Eigen::Vector3d;

PointCloud two_points() {
  PointCloud cloud;
  cloud.positions = {{1, 2, 3}, {4, 5, 6}};
  cloud.normals = {{1, 0, 0}, {0, 1, 0}};
  cloud.sigma_mm = {0.1, 0.2};
  return cloud;
}

TEST(PointCloud, KeepsWhatBothKnowWhenAppended) {
  PointCloud cloud = two_points();
  PointCloud bare;
  bare.positions = {{7, 8, 9}};
  bare.sigma_mm = {0.3};
  cloud.append(bare);
  EXPECT_TRUE(cloud.is_consistent());
  EXPECT_EQ(cloud.size(), 3U);
  EXPECT_FALSE(cloud.has_normals());
  EXPECT_EQ(cloud.sigma_mm.back(), 0.3);
}

TEST(PointCloud, TakesEverythingWhenAppendedToNothing) {
  PointCloud cloud;
  cloud.append(two_points());
  EXPECT_TRUE(cloud.has_normals());
  EXPECT_TRUE(cloud.has_sigma());
  EXPECT_EQ(cloud.size(), 2U);
}

TEST(PointCloud, RemembersWhichPointsWereNotSeen) {
  PointCloud cloud = two_points();
  PointCloud sole = two_points();
  sole.origins = {PointOrigin::kPlatform, PointOrigin::kSeen};
  cloud.append(sole);
  ASSERT_TRUE(cloud.is_consistent());
  EXPECT_TRUE(cloud.was_seen(0));
  EXPECT_FALSE(cloud.was_seen(2));
  EXPECT_TRUE(cloud.was_seen(3));
}

TEST(PointCloud, SubsetTakesAllThatIsKnown) {
  const PointCloud part = two_points().subset({1});
  ASSERT_EQ(part.size(), 1U);
  EXPECT_EQ(part.positions[0], Vector3d(4, 5, 6));
  EXPECT_EQ(part.normals[0], Vector3d(0, 1, 0));
  EXPECT_EQ(part.sigma_mm[0], 0.2);
}

TEST(PointCloud, TurnsNormalsButDoesNotShiftThem) {
  RigidTransform target_from_source = RigidTransform::Identity();
  target_from_source.translate(Vector3d(10, 0, 0));
  target_from_source.rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()));
  const PointCloud moved = transformed(target_from_source, two_points());
  EXPECT_LT((moved.positions[0] - Vector3d(8, 1, 3)).norm(), 1e-12);
  EXPECT_LT((moved.normals[0] - Vector3d(0, 1, 0)).norm(), 1e-12);
}

TEST(CheckCloud, NamesTheFirstBadPoint) {
  PointCloud cloud = two_points();
  cloud.positions[1].y() = std::numeric_limits<double>::quiet_NaN();
  const auto checked = check_cloud(cloud);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(checked.error().message.find("point 1"), std::string::npos);
}

TEST(CheckCloud, RefusesWhatNoFootHolds) {
  PointCloud far = two_points();
  far.positions[0].x() = 1e30;
  EXPECT_FALSE(check_cloud(far));
  PointCloud long_normal = two_points();
  long_normal.normals[0] *= 2.0;
  EXPECT_FALSE(check_cloud(long_normal));
  PointCloud no_noise = two_points();
  no_noise.sigma_mm[0] = 0.0;
  EXPECT_FALSE(check_cloud(no_noise));
  PointCloud all_noise = two_points();
  all_noise.sigma_mm[1] = 1e30;
  EXPECT_FALSE(check_cloud(all_noise));
  PointCloud torn = two_points();
  torn.normals.pop_back();
  EXPECT_FALSE(check_cloud(torn));
  EXPECT_TRUE(check_cloud(two_points()));
}

}  // namespace
}  // namespace instep
