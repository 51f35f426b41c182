#include "core/geometry/rigid_transform.h"

#include <Eigen/SVD>

namespace instep {

bool is_rigid(const Eigen::Matrix4d& matrix, double tolerance) {
  if (!matrix.allFinite()) return false;
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const Eigen::Matrix3d gram = rotation.transpose() * rotation;
  const bool orthonormal = (gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= tolerance;
  const bool last_row = (matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).isZero(tolerance);
  return orthonormal && rotation.determinant() > 0 && last_row;
}

RigidTransform nearest_rigid(const Eigen::Matrix4d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix.topLeftCorner<3, 3>(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  RigidTransform rigid = RigidTransform::Identity();
  rigid.linear() = svd.matrixU() * svd.matrixV().transpose();
  rigid.translation() = matrix.topRightCorner<3, 1>();
  return rigid;
}

}  // namespace instep
