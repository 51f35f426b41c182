#include "core/geometry/drawn_local_errors.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kReachMm = 10.0;
constexpr Eigen::Index kDraws = 4000;

/// Of points that all face upwards.
PointCloud erring_cloud(const std::vector<Vector3d>& positions,
                        const std::vector<double>& sigma_mm) {
  PointCloud cloud;
  cloud.positions = positions;
  cloud.normals.assign(positions.size(), Vector3d::UnitZ());
  cloud.local_errors = {sigma_mm, kReachMm};
  return cloud;
}

/// One draw a row, one point a column.
Eigen::MatrixXd draws_of(const PointCloud& cloud) {
  Eigen::MatrixXd draws(kDraws, static_cast<Eigen::Index>(cloud.size()));
  for (Eigen::Index draw = 0; draw < kDraws; ++draw) {
    const auto errors = drawn_local_errors(cloud, static_cast<std::uint64_t>(draw));
    draws.row(draw) = Eigen::Map<const Eigen::RowVectorXd>(errors.data(), draws.cols());
  }
  return draws;
}

/// The origin, where waves show their phases, and points far from it, each with an error of its
/// own.
PointCloud some_points() {
  test::RandomNumbers random(3);
  std::vector<Vector3d> positions = {Vector3d::Zero()};
  std::vector<double> sigma_mm = {0.4};
  for (int i = 0; i < 11; ++i) {
    positions.emplace_back(random.uniform(-300, 300), random.uniform(-300, 300),
                           random.uniform(0, 300));
    sigma_mm.push_back(0.05 * (i + 1));
  }
  return erring_cloud(positions, sigma_mm);
}

TEST(DrawnLocalErrors, AreAsLargeAsTold) {
  const PointCloud cloud = some_points();
  const Eigen::MatrixXd draws = draws_of(cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto errors =
        draws.col(static_cast<Eigen::Index>(i)).array() / cloud.local_errors.sigma_mm[i];
    EXPECT_NEAR(errors.mean(), 0.0, 0.06) << i;
    EXPECT_NEAR(std::sqrt(errors.square().mean()), 1.0, 0.05) << i;
    const auto within = (errors.abs() < 1.96).count();
    EXPECT_NEAR(static_cast<double>(within) / kDraws, 0.95, 0.015) << i;
  }
}

TEST(DrawnLocalErrors, ReachAsFarAsToldInEveryDirection) {
  test::RandomNumbers random(4);
  const Vector3d middle(120, -80, 60);
  for (int pair = 0; pair < 6; ++pair) {
    const Vector3d along = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const std::vector<double> steps = {0.0, 0.3, 0.6, 1.0, 1.5, 2.5};
    std::vector<Vector3d> positions;
    for (const double step : steps) positions.emplace_back(middle + step * kReachMm * along);
    const auto draws = draws_of(erring_cloud(positions, std::vector<double>(steps.size(), 0.2)));
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const double shared = draws.col(0).dot(draws.col(static_cast<Eigen::Index>(i))) / kDraws;
      EXPECT_NEAR(shared / 0.04, std::exp(-steps[i] * steps[i]), 0.07) << steps[i];
    }
  }
}

TEST(DrawnLocalErrors, OfPointsThatHaveNoneAreZero) {
  PointCloud cloud = some_points();
  cloud.local_errors.sigma_mm[3] = 0.0;
  const auto errors = drawn_local_errors(cloud, 7);
  ASSERT_EQ(errors.size(), cloud.size());
  EXPECT_EQ(errors[3], 0.0);
  EXPECT_NE(errors[2], 0.0);
}

TEST(DrawnLocalErrors, OfOneDrawAreTheSameEveryTime) {
  const PointCloud cloud = some_points();
  EXPECT_EQ(drawn_local_errors(cloud, 7), drawn_local_errors(cloud, 7));
  EXPECT_NE(drawn_local_errors(cloud, 7), drawn_local_errors(cloud, 8));
}

TEST(DrawnLocalErrors, OfOnePointHangOnNoOther) {
  const PointCloud cloud = some_points();
  const auto all = drawn_local_errors(cloud, 7);
  const auto some = drawn_local_errors(cloud.subset({2, 5}), 7);
  EXPECT_EQ(some, (std::vector<double>{all[2], all[5]}));
}

TEST(DrawnLocalErrors, OfDrawsThatFollowEachOtherHaveNothingInCommon) {
  const Eigen::MatrixXd draws = draws_of(some_points());
  for (Eigen::Index point = 0; point < draws.cols(); ++point) {
    const auto before = draws.col(point).head(kDraws - 1);
    const auto after = draws.col(point).tail(kDraws - 1);
    EXPECT_NEAR(before.dot(after) / (before.norm() * after.norm()), 0.0, 0.07) << point;
  }
}

TEST(DrawnLocalErrors, AreNoneWhereNoneAreKnown) {
  PointCloud cloud = some_points();
  cloud.local_errors = {};
  EXPECT_TRUE(drawn_local_errors(cloud, 1).empty());
  EXPECT_TRUE(drawn_local_errors({}, 1).empty());
}

}  // namespace
}  // namespace instep
