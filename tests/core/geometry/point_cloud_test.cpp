#include "core/geometry/point_cloud.h"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(PointCloud, KeepsTheSharedErrorsOfEachPartApart) {
  PointCloud cloud = two_points();
  cloud.shared_errors_mm = {{0.5, 0.6}};
  PointCloud other = two_points();
  other.shared_errors_mm = {{0.7, 0.8}};
  cloud.append(other);
  cloud.append(two_points());
  ASSERT_TRUE(cloud.is_consistent());
  const std::vector<std::vector<double>> expected = {{0.5, 0.6, 0, 0, 0, 0},
                                                     {0, 0, 0.7, 0.8, 0, 0}};
  EXPECT_EQ(cloud.shared_errors_mm, expected);
  const PointCloud part = cloud.subset({1, 3});
  EXPECT_EQ(part.shared_errors_mm, (std::vector<std::vector<double>>{{0.6, 0}, {0, 0.8}}));
  PointCloud bare;
  bare.positions = {{7, 8, 9}};
  cloud.append(bare);
  EXPECT_TRUE(cloud.shared_errors_mm.empty()) << "along what normals?";
  EXPECT_TRUE(cloud.is_consistent());
  cloud = two_points();
  cloud.shared_errors_mm = {{0.5}};
  EXPECT_FALSE(cloud.is_consistent());
}

TEST(PointCloud, KeepsLocalErrors) {
  PointCloud cloud = two_points();
  cloud.append(two_points());
  EXPECT_TRUE(cloud.local_errors.empty());
  PointCloud other = two_points();
  other.local_errors = {{0.5, 0.6}, 7.0};
  cloud.append(other);
  cloud.append(two_points());
  EXPECT_EQ(cloud.local_errors.sigma_mm, (std::vector<double>{0, 0, 0, 0, 0.5, 0.6, 0, 0}));
  EXPECT_EQ(cloud.local_errors.reach_mm, 7.0);
  other.local_errors.reach_mm = 5.0;
  cloud.append(other);
  EXPECT_EQ(cloud.local_errors.reach_mm, 7.0) << "the longer one";
  ASSERT_TRUE(cloud.is_consistent());
  const PointCloud part = cloud.subset({1, 5});
  EXPECT_EQ(part.local_errors.sigma_mm, (std::vector<double>{0, 0.6}));
  EXPECT_EQ(part.local_errors.reach_mm, 7.0);
  PointCloud bare;
  bare.positions = {{7, 8, 9}};
  cloud.append(bare);
  EXPECT_TRUE(cloud.local_errors.empty()) << "along what normals?";
  cloud = two_points();
  cloud.local_errors = {{0.5}, 7.0};
  EXPECT_FALSE(cloud.is_consistent());
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
  PointCloud astray = two_points();
  astray.shared_errors_mm = {{0.5, -0.5}, {0.0, std::nan("")}};
  const auto checked = check_cloud(astray);
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.error().message.find("point 1 has a shared error"), std::string::npos);
  astray.shared_errors_mm[1][1] = -101.0;
  EXPECT_FALSE(check_cloud(astray));
  astray.shared_errors_mm[1][1] = -99.0;
  EXPECT_TRUE(check_cloud(astray));
  astray.normals.clear();
  EXPECT_FALSE(check_cloud(astray)) << "along what normals?";
  PointCloud bent = two_points();
  bent.local_errors = {{0.5, 0.0}, 7.0};
  EXPECT_TRUE(check_cloud(bent));
  bent.local_errors.sigma_mm[1] = -0.1;
  EXPECT_FALSE(check_cloud(bent));
  bent.local_errors = {{0.5, std::nan("")}, 7.0};
  EXPECT_FALSE(check_cloud(bent));
  for (const double reach : {0.0, -1.0, 1e-310, 1e-160, std::nan(""), 1e30}) {
    bent.local_errors = {{0.5, 0.5}, reach};
    EXPECT_FALSE(check_cloud(bent)) << reach;
  }
  bent.local_errors.reach_mm = 7.0;
  bent.normals.clear();
  EXPECT_FALSE(check_cloud(bent)) << "along what normals?";
  bent = two_points();
  bent.local_errors = {{0.5, 0.5}, 7.0};
  bent.shared_errors_mm = {{0.5, 0.5}};
  bent.drop_normals();
  EXPECT_TRUE(check_cloud(bent));
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
