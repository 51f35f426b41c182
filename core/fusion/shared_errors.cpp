#include "core/fusion/shared_errors.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace instep {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr double kUntoldShare = 0.01;

/// The part of a field that turns and shifts what lies about `centre`.
ErrorField rigid_part(const ErrorField& field, const Vector3d& centre) {
  const Matrix3d stretch_and_turn = field.leftCols<3>();
  ErrorField rigid;
  rigid.leftCols<3>() = 0.5 * (stretch_and_turn - stretch_and_turn.transpose());
  rigid.col(3) = field * centre.homogeneous() - rigid.leftCols<3>() * centre;
  return rigid;
}

/// How far each error (column) moves each point (row) along its normal.
MatrixXd moved_along_normals(const PointCloud& cloud, const MatrixXd& shares,
                             const std::vector<ViewErrors>& views) {
  const auto points = static_cast<Eigen::Index>(cloud.size());
  const auto errors = static_cast<Eigen::Index>(views.front().fields.size());
  MatrixXd moved = MatrixXd::Zero(points, errors);
  for (std::size_t v = 0; v < views.size() && static_cast<Eigen::Index>(v) < shares.rows(); ++v) {
    const RigidTransform camera_from_station = views[v].station_from_camera.inverse();
    for (Eigen::Index i = 0; i < points; ++i) {
      const double share = shares(static_cast<Eigen::Index>(v), i);
      if (share == 0.0) continue;
      const auto point = static_cast<std::size_t>(i);
      const Vector3d own = camera_from_station * cloud.positions[point];
      const Vector3d normal = camera_from_station.linear() * cloud.normals[point];
      for (Eigen::Index e = 0; e < errors; ++e) {
        const auto& field = views[v].fields[static_cast<std::size_t>(e)];
        moved(i, e) += share * normal.dot(field * own.homogeneous());
      }
    }
  }
  return moved;
}

}  // namespace

ErrorField in_frame(const RigidTransform& target_from_source, const ErrorField& field) {
  const Matrix3d turn = target_from_source.linear();
  ErrorField moved;
  moved.leftCols<3>() = turn * field.leftCols<3>() * turn.transpose();
  moved.col(3) = turn * field.col(3) - moved.leftCols<3>() * target_from_source.translation();
  return moved;
}

void take_common_motion_out(const Vector3d& centre, std::vector<ViewErrors>& views) {
  if (views.empty()) return;
  for (std::size_t e = 0; e < views.front().fields.size(); ++e) {
    ErrorField common = ErrorField::Zero();
    for (const auto& view : views) {
      common += rigid_part(in_frame(view.station_from_camera, view.fields[e]), centre);
    }
    common /= static_cast<double>(views.size());
    for (auto& view : views) {
      view.fields[e] -= in_frame(view.station_from_camera.inverse(), common);
    }
  }
}

std::vector<std::vector<double>> shared_errors_of(const PointCloud& cloud, const MatrixXd& shares,
                                                  const std::vector<ViewErrors>& views) {
  if (views.empty() || views.front().fields.empty() || cloud.empty()) return {};
  const MatrixXd moved = moved_along_normals(cloud, shares, views);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(moved.transpose() * moved);
  if (solver.info() != Eigen::Success) return {};
  // Independent errors of one sigma stay so however they are turned into each other.
  const double all = solver.eigenvalues().sum();
  double untold = all;
  std::vector<std::vector<double>> errors;
  for (Eigen::Index e = solver.eigenvalues().size() - 1; e >= 0 && untold > kUntoldShare * all;
       --e) {
    const Eigen::VectorXd column = moved * solver.eigenvectors().col(e);
    errors.emplace_back(column.begin(), column.end());
    untold -= solver.eigenvalues()(e);
  }
  return errors;
}

}  // namespace instep
