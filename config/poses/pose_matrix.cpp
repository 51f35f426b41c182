#include "config/poses/pose_matrix.h"

#include "core/fusion/frames/camera_limits.h"
#include "core/geometry/pose_rows.h"

namespace instep {
namespace {

/// Of a matrix for which is_rigid() holds.
RigidTransform without_rounding(const Eigen::Matrix4d& matrix) {
  // Rotations that were written with all their digits are off by a few units of the last one.
  constexpr double kAllDigits = 1e-12;
  if (!is_rigid(matrix, kAllDigits)) return nearest_rigid(matrix);
  RigidTransform rigid = RigidTransform::Identity();
  rigid.linear() = matrix.topLeftCorner<3, 3>();
  rigid.translation() = matrix.topRightCorner<3, 1>();
  return rigid;
}

}  // namespace

std::optional<RigidTransform> read_pose_matrix(SettingsTable& table, SettingsFaults& faults,
                                               const std::string& key) {
  const auto numbers = table.numbers(key, 16);
  if (numbers.empty()) return std::nullopt;
  const Eigen::Matrix4d matrix = matrix_from_rows(numbers);
  if (const auto fault = fault_of_pose(matrix)) {
    faults.add(table.line(key), table.full(key) + ' ' + *fault);
    return std::nullopt;
  }
  return without_rounding(matrix);
}

}  // namespace instep
