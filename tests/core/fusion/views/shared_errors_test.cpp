#include "core/fusion/views/shared_errors.h"

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
    const std::vector<ViewErrors> views = {{{in_frame(kPoses[0].inverse(), first)}, kPoses[0]},
                                           {{in_frame(kPoses[1].inverse(), second)}, kPoses[1]}};
    return shared_errors_of(cloud, Eigen::MatrixXd::Constant(2, 100, 0.5), views);
  };
  const ErrorField motion = rigid_field({0.01, -0.02, 0.005}, {1, 2, 3});
  EXPECT_LT(largest(errors_by(motion, motion)), 1e-9);
  // Opposite motions cancel where both views count alike; one of them alone is half common.
  EXPECT_LT(largest(errors_by(motion, -motion)), 1e-9);
  Vector3d middle = Vector3d::Zero();
  for (const auto& point : cloud.positions) middle += point / 100.0;
  ErrorField growth = ErrorField::Zero();
  growth.leftCols<3>() = 0.01 * Eigen::Matrix3d::Identity();
  growth.col(3) = -0.01 * middle;
  const auto grown = errors_by(growth, growth);
  ASSERT_EQ(grown.size(), 1U);
  for (std::size_t i = 0; i < 100; ++i) {
    const double moved = 0.01 * cloud.normals[i].dot(cloud.positions[i] - middle);
    EXPECT_NEAR(std::abs(grown[0][i]), std::abs(moved), 1e-9);
  }
}

/// Three quarters of the points are of one view, and no point of a third one, which has no errors.
TEST(SharedErrors, AreBesideTheMotionThatViewsHaveInCommonByTheirShares) {
  test::RandomNumbers random(5);
  const PointCloud cloud = ball(80, random);
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(3, 80);
  shares.row(0).head(60).setOnes();
  shares.row(1).tail(20).setOnes();
  const ErrorField motion = rigid_field({0.01, -0.02, 0.005}, {1, 2, 3});
  const auto errors = shared_errors_of(cloud, shares,
                                       {{{in_frame(kPoses[0].inverse(), motion)}, kPoses[0]},
                                        {{in_frame(kPoses[1].inverse(), -3.0 * motion)}, kPoses[1]},
                                        {{}, kPoses[1]}});
  ASSERT_EQ(errors.size(), 1U);
  const auto moved = [&](std::size_t i) {
    const double times = i < 60 ? 1.0 : -3.0;
    return times * cloud.normals[i].dot(motion * cloud.positions[i].homogeneous());
  };
  const double sign = errors[0][0] * moved(0) > 0.0 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < 80; ++i) EXPECT_NEAR(sign * errors[0][i], moved(i), 1e-9);
}

TEST(SharedErrors, CountByHowMuchTheirViewDoes) {
  PointCloud cloud;
  cloud.positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  cloud.normals = {{1, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Eigen::MatrixXd shares(2, 3);
  shares << 1.0, 0.25, 1.0, 0.0, 0.75, 0.0;
  const auto along_x = [](double shift, const RigidTransform& pose) {
    return ViewErrors{{in_frame(pose.inverse(), rigid_field(Vector3d::Zero(), {shift, 0, 0}))},
                      pose};
  };
  const auto errors =
      shared_errors_of(cloud, shares, {along_x(0.4, kPoses[0]), along_x(-0.8, kPoses[1])});
  ASSERT_EQ(errors.size(), 1U);
  const double sign = errors[0][0] > 0.0 ? 1.0 : -1.0;
  // Together they move by (2.25 * 0.4 - 0.75 * 0.8) / 3.
  EXPECT_NEAR(sign * errors[0][0], 0.3, 1e-12);
  EXPECT_NEAR(sign * errors[0][1], 0.25 * 0.3 - 0.75 * 0.9, 1e-12);
  EXPECT_NEAR(errors[0][2], 0.0, 1e-12);
}

/// Twenty errors of which most are small: the few that are told have the covariance of them all.
TEST(SharedErrors, AreFewAndSayTheSame) {
  test::RandomNumbers random(3);
  const PointCloud cloud = ball(60, random);
  std::vector<ViewErrors> views = {{{}, kPoses[0]}, {{}, kPoses[1]}};
  constexpr int kErrors = 20;
  Vector3d middle = Vector3d::Zero();
  for (const auto& point : cloud.positions) middle += point / 60.0;
  for (auto& view : views) {
    for (int e = 0; e < kErrors; ++e) {
      // A stretch about the middle moves nothing as one body.
      Eigen::Matrix3d stretch;
      for (double& part : stretch.reshaped()) part = std::pow(0.6, e) * random.normal();
      ErrorField field;
      field.leftCols<3>() = stretch + stretch.transpose();
      field.col(3) = -field.leftCols<3>() * middle;
      view.fields.push_back(in_frame(view.station_from_camera.inverse(), field));
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
  EXPECT_TRUE(shared_errors_of({}, Eigen::MatrixXd(1, 0), {{{}, kPoses[0]}}).empty());
}

}  // namespace
}  // namespace instep
