#include "core/fusion/registration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/geometry/point_index.h"
#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLeastNormalCosine = 0.85;
constexpr double kLeastViewCosine = 0.2;  // of a surface that another camera can see
/// Neighbouring points share most of their error: so many count as one against the given poses.
constexpr double kPointsInOne = 30.0;

/// A view as the matching needs it, in the given station frame, and its pose as it stands.
struct MovingView {
  PointCloud queries;
  PointCloud targets;
  std::unique_ptr<PointIndex> index;
  Vector3d centroid = Vector3d::Zero();
  Vector3d towards_camera = Vector3d::Zero();
  RigidTransform correction = RigidTransform::Identity();
  bool taking_part = false;
};

struct Match {
  std::size_t view;
  std::size_t other;
  Vector3d point;    ///< of `view`, corrected
  Vector3d partner;  ///< of `other`, corrected
  Vector3d normal;
  double distance;  ///< along the normal
};

PointCloud even_subset(const PointCloud& cloud, std::size_t most) {
  std::vector<std::size_t> indices;
  const double stride =
      std::max(1.0, static_cast<double>(cloud.size()) / static_cast<double>(most));
  for (double at = 0.0; at < static_cast<double>(cloud.size()); at += stride) {
    indices.push_back(static_cast<std::size_t>(at));
  }
  return cloud.subset(indices);
}

Vector3d mean(const std::vector<Vector3d>& vectors) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& vector : vectors) sum += vector;
  return sum / static_cast<double>(std::max<std::size_t>(1, vectors.size()));
}

std::vector<MovingView> prepare(const std::vector<PointCloud>& views,
                                const RegistrationSettings& settings) {
  std::vector<MovingView> moving(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].empty() || !views[i].has_normals() || views[i].view_directions.empty()) continue;
    moving[i].queries = even_subset(views[i], settings.queries);
    moving[i].targets = even_subset(views[i], settings.targets);
    moving[i].index = std::make_unique<PointIndex>(moving[i].targets.positions);
    moving[i].centroid = mean(moving[i].targets.positions);
    moving[i].towards_camera = mean(moving[i].targets.view_directions).normalized();
    moving[i].taking_part = true;
  }
  return moving;
}

/// All queries of `view` that find the same surface in `other` within `reach`.
void match_pair(const std::vector<MovingView>& views, std::size_t view, std::size_t other,
                double reach, std::vector<Match>& matches) {
  const auto& source = views[view];
  const auto& target = views[other];
  const RigidTransform other_from_view = target.correction.inverse() * source.correction;
  for (std::size_t i = 0; i < source.queries.size(); ++i) {
    const Vector3d normal = other_from_view.linear() * source.queries.normals[i];
    if (normal.dot(target.towards_camera) < kLeastViewCosine) continue;
    const Vector3d point = other_from_view * source.queries.positions[i];
    const auto found = target.index->nearest(point, 1);
    if (found.empty() || found[0].squared_distance > reach * reach) continue;
    const Vector3d& partner = target.targets.positions[found[0].index];
    const Vector3d& partner_normal = target.targets.normals[found[0].index];
    if (normal.dot(partner_normal) < kLeastNormalCosine) continue;
    const Vector3d middle = (normal + partner_normal).normalized();
    matches.push_back({view, other, target.correction * point, target.correction * partner,
                       target.correction.linear() * middle, middle.dot(point - partner)});
  }
}

std::vector<Match> match_all(const std::vector<MovingView>& views, double reach) {
  std::vector<Match> matches;
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (std::size_t other = 0; other < views.size(); ++other) {
      if (view == other || !views[view].taking_part || !views[other].taking_part) continue;
      match_pair(views, view, other, reach, matches);
    }
  }
  return matches;
}

double tukey(double distance, double reach) {
  const double ratio = distance / reach;
  return std::abs(ratio) >= 1.0 ? 0.0 : (1 - ratio * ratio) * (1 - ratio * ratio);
}

Vector3d corrected_centroid(const MovingView& view) {
  return view.correction * view.centroid;
}

/// How `distance` of a match changes with a small turn about the centroid and a small shift.
Vector6 gradient(const MovingView& view, const Vector3d& point, const Vector3d& normal) {
  Vector6 row;
  // Not by commas: with wide vectors GCC 12 takes those for reads beyond the cross product.
  row.head<3>() = (point - corrected_centroid(view)).cross(normal);
  row.tail<3>() = normal;
  return row;
}

void add_prior(const MovingView& view, const RegistrationSettings& settings, Eigen::Index at,
               Eigen::MatrixXd& matrix, Eigen::VectorXd& right) {
  const Eigen::AngleAxisd turn(view.correction.linear());
  const Vector3d turned = turn.angle() * turn.axis();
  const Vector3d shifted = corrected_centroid(view) - view.centroid;
  const double turn_weight = 1.0 / std::pow(settings.pose_sigma_deg * kDegree, 2);
  const double shift_weight = 1.0 / std::pow(settings.pose_sigma_mm, 2);
  for (Eigen::Index i = 0; i < 3; ++i) {
    matrix(at + i, at + i) += turn_weight;
    right(at + i) -= turn_weight * turned(i);
    matrix(at + 3 + i, at + 3 + i) += shift_weight;
    right(at + 3 + i) -= shift_weight * shifted(i);
  }
}

/// One Gauss-Newton step of all poses.
void step(std::vector<MovingView>& views, const std::vector<Match>& matches, double reach,
          const RegistrationSettings& settings) {
  const auto size = static_cast<Eigen::Index>(6 * views.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  for (const auto& match : matches) {
    const double weight = tukey(match.distance, reach) / kPointsInOne;
    if (weight == 0.0) continue;
    const Vector6 a = gradient(views[match.view], match.point, match.normal);
    const Vector6 b = -gradient(views[match.other], match.partner, match.normal);
    const auto at = static_cast<Eigen::Index>(6 * match.view);
    const auto other = static_cast<Eigen::Index>(6 * match.other);
    matrix.block<6, 6>(at, at) += weight * a * a.transpose();
    matrix.block<6, 6>(other, other) += weight * b * b.transpose();
    matrix.block<6, 6>(at, other) += weight * a * b.transpose();
    matrix.block<6, 6>(other, at) += weight * b * a.transpose();
    right.segment<6>(at) -= weight * match.distance * a;
    right.segment<6>(other) -= weight * match.distance * b;
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    add_prior(views[i], settings, static_cast<Eigen::Index>(6 * i), matrix, right);
  }
  const Eigen::VectorXd solved = matrix.ldlt().solve(right);
  if (!solved.allFinite()) return;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Vector3d turn = solved.segment<3>(static_cast<Eigen::Index>(6 * i));
    const Vector3d shift = solved.segment<3>(static_cast<Eigen::Index>(6 * i + 3));
    const Vector3d centre = corrected_centroid(views[i]);
    RigidTransform move = RigidTransform::Identity();
    if (turn.norm() > 0.0) {
      move.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    }
    move.translation() = centre + shift - move.linear() * centre;
    views[i].correction = move * views[i].correction;
  }
}

double median_residual(const std::vector<Match>& matches) {
  std::vector<double> distances;
  for (const auto& match : matches) distances.push_back(std::abs(match.distance));
  return median(std::move(distances));
}

/// False if it was cancelled.
bool solve(std::vector<MovingView>& views, const RegistrationSettings& settings,
           const GoOn& go_on) {
  for (auto& view : views) view.correction = RigidTransform::Identity();
  const double shrink = settings.last_reach_mm / settings.first_reach_mm;
  for (int i = 0; i < settings.iterations; ++i) {
    // The last third stays at the last reach, to settle.
    const double progress = std::min(1.0, 1.5 * i / std::max(1, settings.iterations - 1));
    const double reach = settings.first_reach_mm * std::pow(shrink, progress);
    const auto matches = match_all(views, reach);
    if (matches.empty()) return true;
    step(views, matches, reach, settings);
    if (!go_on()) return false;
  }
  return true;
}

RegisteredView judge(const std::vector<MovingView>& views, std::size_t at,
                     const std::vector<Match>& matches, const RegistrationSettings& settings) {
  RegisteredView judged;
  const auto& view = views[at];
  if (!view.taking_part) return judged;
  std::vector<double> distances;
  std::vector<Vector3d> matched;
  for (const auto& match : matches) {
    if (match.view != at) continue;
    distances.push_back(std::abs(match.distance));
    if (matched.empty() || matched.back() != match.point) matched.push_back(match.point);
  }
  judged.overlap = static_cast<double>(matched.size()) / static_cast<double>(view.queries.size());
  judged.residual_mm = median(std::move(distances));
  judged.correction = view.correction;
  const double shift = (corrected_centroid(view) - view.centroid).norm();
  const double turn = Eigen::AngleAxisd(view.correction.linear()).angle();
  const bool too_far = shift > settings.most_shift_mm || turn > settings.most_turn_deg * kDegree;
  if (too_far || judged.residual_mm > settings.most_residual_mm) {
    judged.fit = ViewFit::kDoesNotFit;
  } else if (judged.overlap >= settings.least_overlap) {
    judged.fit = ViewFit::kFits;
  }
  return judged;
}

}  // namespace

Result<Registration> register_views(const std::vector<PointCloud>& views,
                                    const RegistrationSettings& settings, const GoOn& go_on) {
  auto moving = prepare(views, settings);
  Registration registration;
  registration.views.resize(views.size());
  registration.residual_before_mm = median_residual(match_all(moving, settings.first_reach_mm));
  for (std::size_t round = 0; round <= views.size(); ++round) {
    if (!solve(moving, settings, go_on)) return cancelled();
    const auto matches = match_all(moving, 2.0 * settings.last_reach_mm);
    registration.residual_after_mm = median_residual(matches);
    std::size_t worst = views.size();
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (registration.views[i].fit == ViewFit::kDoesNotFit) continue;
      registration.views[i] = judge(moving, i, matches, settings);
      if (registration.views[i].fit != ViewFit::kDoesNotFit) continue;
      if (worst == views.size() ||
          registration.views[i].residual_mm > registration.views[worst].residual_mm) {
        worst = i;
      }
    }
    if (worst == views.size()) break;
    // One at a time: a bad view spoils its neighbours.
    moving[worst].taking_part = false;
    registration.views[worst].correction = RigidTransform::Identity();
  }
  return registration;
}

}  // namespace instep
