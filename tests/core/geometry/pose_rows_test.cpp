#include "core/geometry/pose_rows.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

using Eigen::Vector3d;

TEST(PoseRows, GoesRowByRow) {
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  pose.translation() = Vector3d(10, 20, 30);
  const std::vector<double> rows = {0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 1, 30, 0, 0, 0, 1};
  EXPECT_EQ(pose_rows(pose), rows);
  EXPECT_EQ(matrix_from_rows(rows), pose.matrix());
}

}  // namespace
}  // namespace instep
