#include "core/fusion/shared_errors.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

RigidTransform some_pose(double turn, const Vector3d& place) {
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() = Eigen::AngleAxisd(turn, Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  pose.translation() = place;
  return pose;
}

const std::vector<RigidTransform> kPoses = {some_pose(0.3, {500, 20, 300}),
                                            some_pose(2.1, {-400, 90, 280})};

/// Turns and shifts, in the station.
ErrorField rigid_field(const Vector3d& turn, const Vector3d& shift) {
  ErrorField field;
  for (int i = 0; i < 3; ++i) field.col(i) = turn.cross(Vector3d::Unit(i));
  field.col(3) = shift;
  return field;
}

PointCloud ball(std::size_t count, test::RandomNumbers& random) {
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d out = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    cloud.positions.push_back(50.0 * out + Vector3d(10, 0, 40));
    cloud.normals.push_back(out);
  }
  return cloud;
}

double largest(const std::vector<std::vector<double>>& errors) {
  double most = 0.0;
  for (const auto& error : errors) {
    for (const double value : error) most = std::max(most, std::abs(value));
  }
  return most;
}

TEST(ErrorField, MovesAPointTheSameInAnyFrame) {
  test::RandomNumbers random(1);
  ErrorField field;
  for (double& part : field.reshaped()) part = random.normal();
  const Vector3d place(20, -30, 60);
  const RigidTransform& pose = kPoses[0];
  const Vector3d there = in_frame(pose, field) * (pose * place).homogeneous();
  EXPECT_NEAR((there - pose.linear() * (field * place.homogeneous())).norm(), 0.0, 1e-9);
}

TEST(SharedErrors, KnowNothingOfWhatMovesAllViewsAlike) {
  test::RandomNumbers random(2);
  const PointCloud cloud = ball(100, random);
  const auto errors_by = [&](const ErrorField& first, const ErrorField& second) {
    std::vector<ViewErrors> views = {{{in_frame(kPoses[0].inverse(), first)}, 1.0, kPoses[0]},
                                     {{in_frame(kPoses[1].inverse(), second)}, 1.0, kPoses[1]}};
    take_common_motion_out({10, 0, 40}, views);
    return shared_errors_of(cloud, Eigen::MatrixXd::Constant(2, 100, 0.5), views);
  };
  const ErrorField motion = rigid_field({0.01, -0.02, 0.005}, {1, 2, 3});
  EXPECT_LT(largest(errors_by(motion, motion)), 1e-9);
  // Opposite motions cancel where both views count alike; one of them alone is half common.
  EXPECT_LT(largest(errors_by(motion, -motion)), 1e-9);
  ErrorField growth = ErrorField::Zero();
  growth.leftCols<3>() = 0.01 * Eigen::Matrix3d::Identity();
  growth.col(3) = -0.01 * Vector3d(10, 0, 40);
  const auto grown = errors_by(growth, growth);
  ASSERT_EQ(grown.size(), 1U);
  for (const double value : grown[0]) EXPECT_NEAR(std::abs(value), 0.5, 1e-9);
}

TEST(SharedErrors, HaveNoCommonMotionByTheSharesOfTheirViews) {
  const ErrorField motion = rigid_field({0.01, -0.02, 0.005}, {1, 2, 3});
  std::vector<ViewErrors> views = {
      {{in_frame(kPoses[0].inverse(), motion)}, 0.75, kPoses[0]},
      {{in_frame(kPoses[1].inverse(), -3.0 * motion)}, 0.25, kPoses[1]},
      {{}, 0.0, kPoses[1]}};
  auto with_one_blind = views;
  with_one_blind[1].fields.clear();
  take_common_motion_out({10, 0, 40}, views);
  EXPECT_TRUE(in_frame(kPoses[0], views[0].fields[0]).isApprox(motion, 1e-9));
  take_common_motion_out({10, 0, 40}, with_one_blind);
  ASSERT_EQ(with_one_blind[1].fields.size(), 1U);
  EXPECT_TRUE(in_frame(kPoses[1], with_one_blind[1].fields[0]).isApprox(-0.75 * motion, 1e-9));
}

TEST(SharedErrors, CountByHowMuchTheirViewDoes) {
  PointCloud cloud;
  cloud.positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  cloud.normals = {{1, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Eigen::MatrixXd shares(2, 3);
  shares << 1.0, 0.25, 1.0, 0.0, 0.75, 0.0;
  const auto along_x = [](double shift, const RigidTransform& pose) {
    return ViewErrors{
        {in_frame(pose.inverse(), rigid_field(Vector3d::Zero(), {shift, 0, 0}))}, 1.0, pose};
  };
  const auto errors =
      shared_errors_of(cloud, shares, {along_x(0.4, kPoses[0]), along_x(-0.8, kPoses[1])});
  ASSERT_EQ(errors.size(), 1U);
  const double sign = errors[0][0] > 0.0 ? 1.0 : -1.0;
  EXPECT_NEAR(sign * errors[0][0], 0.4, 1e-12);
  EXPECT_NEAR(sign * errors[0][1], 0.25 * 0.4 - 0.75 * 0.8, 1e-12);
  EXPECT_NEAR(errors[0][2], 0.0, 1e-12);
}

/// Twenty errors of which most are small: the few that are told have the covariance of them all.
TEST(SharedErrors, AreFewAndSayTheSame) {
  test::RandomNumbers random(3);
  const PointCloud cloud = ball(60, random);
  std::vector<ViewErrors> views = {{{}, 1.0, kPoses[0]}, {{}, 1.0, kPoses[1]}};
  constexpr int kErrors = 20;
  for (auto& view : views) {
    for (int e = 0; e < kErrors; ++e) {
      ErrorField field;
      for (double& part : field.reshaped()) part = std::pow(0.6, e) * random.normal();
      view.fields.push_back(field);
    }
  }
  Eigen::MatrixXd shares = Eigen::MatrixXd::Constant(2, 60, 0.5);
  const auto errors = shared_errors_of(cloud, shares, views);
  EXPECT_LT(errors.size(), 12U);
  double all = 0.0;
  double told = 0.0;
  double differences = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (std::size_t j = 0; j < cloud.size(); ++j) {
      double covariance = 0.0;
      for (std::size_t e = 0; e < kErrors; ++e) {
        const auto moved = [&](std::size_t point) {
          double sum = 0.0;
          for (const auto& view : views) {
            const Vector3d own = view.station_from_camera.inverse() * cloud.positions[point];
            const Vector3d shift =
                view.station_from_camera.linear() * (view.fields[e] * own.homogeneous());
            sum += 0.5 * cloud.normals[point].dot(shift);
          }
          return sum;
        };
        covariance += moved(i) * moved(j);
      }
      double own = 0.0;
      for (const auto& error : errors) own += error[i] * error[j];
      if (i == j) all += covariance;
      if (i == j) told += own;
      differences = std::max(differences, std::abs(covariance - own));
    }
  }
  EXPECT_GT(told, 0.99 * all);
  EXPECT_LE(told, all * (1.0 + 1e-9));
  EXPECT_LT(differences, 0.02 * all);
}

TEST(SharedErrors, OfNothingAreNone) {
  test::RandomNumbers random(4);
  EXPECT_TRUE(shared_errors_of(ball(5, random), Eigen::MatrixXd::Ones(1, 5), {}).empty());
  EXPECT_TRUE(shared_errors_of({}, Eigen::MatrixXd(1, 0), {{{}, 1.0, kPoses[0]}}).empty());
}

}  // namespace
}  // namespace instep
