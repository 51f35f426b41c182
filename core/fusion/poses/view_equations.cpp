#include "core/fusion/poses/view_equations.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/degree.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Neighbouring points share most of their error: so many count as one against what is expected.
constexpr double kPointsInOne = 30.0;
/// As a share that is nothing, but of which a weight can be taken.
constexpr double kExactLens = 1e-9;

double tukey(double distance, double reach) {
  const double ratio = distance / reach;
  return std::abs(ratio) >= 1.0 ? 0.0 : (1 - ratio * ratio) * (1 - ratio * ratio);
}

/// The line of sight through the middle of the image, in the station.
Vector3d corrected_axis(const MovingView& view) {
  return view.pose_correction.linear() * view.optical_axis();
}

/// How `distance` of a match changes with what is unknown of a view.
UnknownsVector gradient(const MovingView& view, const Vector3d& point, const Vector3d& normal) {
  const Vector3d arm = point - view.corrected_centroid();
  const Vector3d axis = corrected_axis(view);
  UnknownsVector row;
  // Not by commas: with wide vectors GCC 12 takes those for reads beyond the cross product.
  row.head<3>() = arm.cross(normal);
  row.segment<3>(3) = normal;
  row(6) = normal.dot(axis) * axis.dot(arm);
  row(7) = normal.dot(arm) - row(6);
  return row;
}

double weight_of(const ViewMatch& match, double reach_mm, double shared_variance) {
  return tukey(match.distance, reach_mm) / (kPointsInOne * (match.variance + shared_variance));
}

/// How the distance of a match along a direction changes with what is unknown of its two views.
struct MatchRow {
  Eigen::Index at;
  Eigen::Index other_at;
  UnknownsVector own;
  UnknownsVector other;
};

MatchRow row_of(const ViewMatch& match, const Vector3d& direction,
                const std::vector<MovingView>& views) {
  // The foot of the point on the other's tangent plane: its nearest sample lies aside, and would
  // turn all views together, which changes nothing between them.
  const Vector3d foot = match.point - match.distance * match.normal;
  return {first_unknown(match.view), first_unknown(match.other),
          gradient(views[match.view], match.point, direction),
          -gradient(views[match.other], foot, direction)};
}

void add_square(const MatchRow& row, double weight, Eigen::MatrixXd& matrix) {
  const auto& [at, other_at, own, other] = row;
  matrix.block<kUnknowns, kUnknowns>(at, at) += weight * own * own.transpose();
  matrix.block<kUnknowns, kUnknowns>(other_at, other_at) += weight * other * other.transpose();
  matrix.block<kUnknowns, kUnknowns>(at, other_at) += weight * own * other.transpose();
  matrix.block<kUnknowns, kUnknowns>(other_at, at) += weight * other * own.transpose();
}

/// What was made of the unknowns by now.
UnknownsVector found_of(const MovingView& view) {
  const Eigen::AngleAxisd turn(view.pose_correction.linear());
  UnknownsVector found;
  found.head<3>() = turn.angle() * turn.axis();
  found.segment<3>(3) = view.corrected_centroid() - view.centroid;
  found(6) = view.deeper;
  found(7) = view.wider;
  return found;
}

}  // namespace

NormalEquations equations_of(const std::vector<MovingView>& views,
                             const std::vector<ViewMatch>& matches, double reach_mm) {
  const Eigen::Index size = first_unknown(views.size());
  NormalEquations equations{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  const double shared_variance = std::pow(unexplained(matches), 2);
  for (const auto& match : matches) {
    const double weight = weight_of(match, reach_mm, shared_variance);
    if (weight == 0.0) continue;
    const MatchRow row = row_of(match, match.normal, views);
    add_square(row, weight, equations.matrix);
    equations.right.segment<kUnknowns>(row.at) -= weight * match.distance * row.own;
    equations.right.segment<kUnknowns>(row.other_at) -= weight * match.distance * row.other;
  }
  return equations;
}

void take_out_noise_of_normals(double variance, const std::vector<MovingView>& views,
                               const std::vector<ViewMatch>& matches, double reach_mm,
                               NormalEquations& equations) {
  const double shared_variance = std::pow(unexplained(matches), 2);
  for (const auto& match : matches) {
    const double weight = weight_of(match, reach_mm, shared_variance);
    if (weight == 0.0) continue;
    const Vector3d along = match.normal.unitOrthogonal();
    for (const Vector3d& lean : {along, Vector3d(match.normal.cross(along))}) {
      add_square(row_of(match, lean, views), -variance * weight, equations.matrix);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> told(equations.matrix);
  if (told.info() != Eigen::Success) return;
  equations.matrix = told.eigenvectors() * told.eigenvalues().cwiseMax(0.0).asDiagonal() *
                     told.eigenvectors().transpose();
}

void add_expected(const ExpectedErrors& expected, const std::vector<MovingView>& views,
                  NormalEquations& equations) {
  UnknownsVector sigmas;
  sigmas.head<3>().setConstant(expected.pose_deg * kDegree);
  sigmas.segment<3>(3).setConstant(expected.pose_mm);
  sigmas.tail<2>().setConstant(std::max(expected.lens, kExactLens));
  const UnknownsVector weights = sigmas.cwiseAbs2().cwiseInverse();
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Eigen::Index at = first_unknown(i);
    equations.matrix.diagonal().segment<kUnknowns>(at) += weights;
    equations.right.segment<kUnknowns>(at) -= weights.cwiseProduct(found_of(views[i]));
  }
}

double move_by(const Eigen::VectorXd& step, std::vector<MovingView>& views) {
  double furthest_mm = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const UnknownsVector own = step.segment<kUnknowns>(first_unknown(i));
    const Vector3d turn = own.head<3>();
    const Vector3d shift = own.segment<3>(3);
    const Vector3d centre = views[i].corrected_centroid();
    RigidTransform moved = RigidTransform::Identity();
    if (turn.norm() > 0.0) {
      moved.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    }
    moved.translation() = centre + shift - moved.linear() * centre;
    views[i].pose_correction = moved * views[i].pose_correction;
    views[i].deeper += own(6);
    views[i].wider += own(7);
    furthest_mm = std::max(furthest_mm, shift.norm() + kArmMm * turn.norm());
  }
  return furthest_mm;
}

ErrorField error_field(const MovingView& view, const UnknownsVector& off) {
  const Vector3d turn = off.head<3>();
  const Vector3d axis = corrected_axis(view);
  Eigen::Matrix3d local = off(7) * Eigen::Matrix3d::Identity();
  local += (off(6) - off(7)) * axis * axis.transpose();
  for (int i = 0; i < 3; ++i) local.col(i) += turn.cross(Vector3d::Unit(i));
  ErrorField field;
  field.leftCols<3>() = local;
  field.col(3) = off.segment<3>(3) - local * view.corrected_centroid();
  return field;
}

}  // namespace instep
