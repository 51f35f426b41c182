#include "core/geometry/pose_rows.h"

namespace instep {
namespace {

using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

}  // namespace

std::vector<double> pose_rows(const RigidTransform& pose) {
  const RowMajor matrix = pose.matrix();
  return {matrix.data(), matrix.data() + matrix.size()};
}

Eigen::Matrix4d matrix_from_rows(const std::vector<double>& rows) {
  return Eigen::Map<const RowMajor>(rows.data());
}

}  // namespace instep
