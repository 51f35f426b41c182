#include "core/geometry/rigid_transform.h"

#include <gtest/gtest.h>

#include <limits>

namespace instep {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;

Matrix4d some_pose() {
  RigidTransform pose = RigidTransform::Identity();
  pose.rotate(Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()));
  pose.pretranslate(Vector3d(100, -50, 20));
  return pose.matrix();
}

TEST(RigidTransform, TakesARotationWithAShift) {
  EXPECT_TRUE(is_rigid(some_pose()));
}

TEST(RigidTransform, RefusesScaleMirrorShearAndNaN) {
  Matrix4d scaled = some_pose();
  scaled.topLeftCorner<3, 3>() *= 1.01;
  EXPECT_FALSE(is_rigid(scaled));
  Matrix4d mirrored = some_pose();
  mirrored.col(0) *= -1;
  EXPECT_FALSE(is_rigid(mirrored));
  Matrix4d projective = some_pose();
  projective(3, 0) = 0.1;
  EXPECT_FALSE(is_rigid(projective));
  Matrix4d nan = some_pose();
  nan(0, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_rigid(nan));
}

TEST(NearestRigid, TakesRoundedDecimalsOutOfTheRotation) {
  Matrix4d rounded = some_pose();
  rounded = (rounded * 1e4).array().round().matrix() / 1e4;
  const RigidTransform rigid = nearest_rigid(rounded);
  EXPECT_LT((rigid.linear().transpose() * rigid.linear() - Eigen::Matrix3d::Identity()).norm(),
            1e-14);
  EXPECT_LT((rigid.matrix() - some_pose()).norm(), 5e-4);
}

}  // namespace
}  // namespace instep
