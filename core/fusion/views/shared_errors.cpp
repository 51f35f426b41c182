#include "core/fusion/views/shared_errors.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>

#include "core/mean.h"

namespace instep {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr double kUntoldShare = 0.01;
/// By so many of the points, about, the main errors are told from the others.
constexpr std::size_t kPointsToMixBy = 2000;

/// The part of a field that turns and shifts what lies about `centre`.
ErrorField rigid_part(const ErrorField& field, const Vector3d& centre) {
  const Matrix3d stretch_and_turn = field.leftCols<3>();
  ErrorField rigid;
  rigid.leftCols<3>() = 0.5 * (stretch_and_turn - stretch_and_turn.transpose());
  rigid.col(3) = field * centre.homogeneous() - rigid.leftCols<3>() * centre;
  return rigid;
}

std::size_t number_of_errors(const std::vector<ViewErrors>& views) {
  std::size_t most = 0;
  for (const auto& view : views) most = std::max(most, view.fields.size());
  return most;
}

/// The errors without what moves the views together, each by its share, as one rigid body about
/// `centre`.
std::vector<ViewErrors> without_common_motion(std::vector<ViewErrors> views,
                                              const Eigen::VectorXd& shares,
                                              const Vector3d& centre) {
  const std::size_t errors = number_of_errors(views);
  for (auto& view : views) view.fields.resize(errors, ErrorField::Zero());
  for (std::size_t e = 0; e < errors; ++e) {
    ErrorField common = ErrorField::Zero();
    for (std::size_t v = 0; v < views.size(); ++v) {
      const ErrorField field = in_frame(views[v].station_from_camera, views[v].fields[e]);
      common += shares(static_cast<Eigen::Index>(v)) * rigid_part(field, centre);
    }
    for (auto& view : views) {
      view.fields[e] -= in_frame(view.station_from_camera.inverse(), common);
    }
  }
  return views;
}

/// How far each error (column) moves every `stride`th point (row) along its normal.
MatrixXd moved_along_normals(const PointCloud& cloud, const MatrixXd& shares,
                             const std::vector<ViewErrors>& views, std::size_t stride) {
  const auto points = static_cast<Eigen::Index>((cloud.size() + stride - 1) / stride);
  const auto errors = static_cast<Eigen::Index>(number_of_errors(views));
  MatrixXd moved = MatrixXd::Zero(points, errors);
  for (std::size_t v = 0; v < views.size(); ++v) {
    const RigidTransform camera_from_station = views[v].station_from_camera.inverse();
    for (std::size_t point = 0; point < cloud.size(); point += stride) {
      const double share = shares(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(point));
      if (share == 0.0) continue;
      const Vector3d own = camera_from_station * cloud.positions[point];
      const Vector3d normal = camera_from_station.linear() * cloud.normals[point];
      const auto row = static_cast<Eigen::Index>(point / stride);
      for (std::size_t e = 0; e < views[v].fields.size(); ++e) {
        moved(row, static_cast<Eigen::Index>(e)) +=
            share * normal.dot(views[v].fields[e] * own.homogeneous());
      }
    }
  }
  return moved;
}

/// Independent errors of one sigma stay so however they are turned into each other: the mixtures
/// (columns) that move the points most.
MatrixXd main_mixtures(MatrixXd moved) {
  // Else one view that is known ill would hide what the others leave unknown elsewhere.
  for (auto point : moved.rowwise()) point.stableNormalize();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(moved.transpose() * moved);
  if (solver.info() != Eigen::Success) return MatrixXd(moved.cols(), 0);
  const double all = solver.eigenvalues().sum();
  double untold = all;
  Eigen::Index count = 0;
  const Eigen::Index most = std::min<Eigen::Index>(moved.cols(), kMostSharedErrors);
  while (count < most && untold > kUntoldShare * all) {
    untold -= solver.eigenvalues()(moved.cols() - 1 - count);
    ++count;
  }
  return solver.eigenvectors().rightCols(count).rowwise().reverse();
}

/// The same fields, mixed.
std::vector<ErrorField> mixed(const std::vector<ErrorField>& fields, const MatrixXd& mixtures) {
  std::vector<ErrorField> made(static_cast<std::size_t>(mixtures.cols()), ErrorField::Zero());
  for (std::size_t to = 0; to < made.size(); ++to) {
    for (std::size_t from = 0; from < fields.size(); ++from) {
      made[to] +=
          mixtures(static_cast<Eigen::Index>(from), static_cast<Eigen::Index>(to)) * fields[from];
    }
  }
  return made;
}

}  // namespace

ErrorField in_frame(const RigidTransform& target_from_source, const ErrorField& field) {
  const Matrix3d turn = target_from_source.linear();
  ErrorField moved;
  moved.leftCols<3>() = turn * field.leftCols<3>() * turn.transpose();
  moved.col(3) = turn * field.col(3) - moved.leftCols<3>() * target_from_source.translation();
  return moved;
}

std::vector<std::vector<double>> shared_errors_of(const PointCloud& cloud, const MatrixXd& shares,
                                                  const std::vector<ViewErrors>& views) {
  if (number_of_errors(views) == 0 || cloud.empty()) return {};
  const Vector3d centre = mean_of(cloud.positions);
  auto own = without_common_motion(views, shares.rowwise().mean(), centre);
  const std::size_t stride = std::max<std::size_t>(1, cloud.size() / kPointsToMixBy);
  const MatrixXd mixtures = main_mixtures(moved_along_normals(cloud, shares, own, stride));
  for (auto& view : own) view.fields = mixed(view.fields, mixtures);
  std::vector<std::vector<double>> errors;
  const MatrixXd moved = moved_along_normals(cloud, shares, own, 1);
  for (const auto& column : moved.colwise()) errors.emplace_back(column.begin(), column.end());
  return errors;
}

}  // namespace instep
