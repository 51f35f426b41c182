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
/// What even a pixel that lies still may be off by, by its lens and its unit of depth.
constexpr double kLeastSigmaMm = 0.05;
constexpr double kArmMm = 150.0;  // from the middle of a foot to its ends
constexpr double kStillMm = 0.01;
/// Of the median distance of the views so far do matches reach.
constexpr double kReachInResiduals = 8.0;
/// While the views move much, one query in so many will do.
constexpr std::size_t kCoarseStride = 4;
constexpr std::size_t kFineStride = 1;
constexpr int kLastSteps = 4;  // at most, each time that more is known of the poses
/// Errors of the poses, in those that the overlaps show. Hardly matters: of 720 measures of
/// simulated feet by poses that were off by 0 to 2 mm, 90.0 % held with 1, 90.4 % with 1.5, 89.7 %
/// with 2.
constexpr double kLikelyErrors = 1.5;
constexpr double kLeastPoseMm = 1e-3;

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
  Vector3d point;  ///< of `view`, corrected
  Vector3d normal;
  double distance;  ///< along the normal
  double variance;  ///< of that
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
    const bool can_be_matched = !views[i].empty() && views[i].has_normals() &&
                                views[i].has_sigma() && !views[i].view_directions.empty();
    if (!can_be_matched) continue;
    moving[i].queries = even_subset(views[i], settings.queries);
    moving[i].targets = even_subset(views[i], settings.targets);
    moving[i].index = std::make_unique<PointIndex>(moving[i].targets.positions);
    moving[i].centroid = mean(moving[i].targets.positions);
    moving[i].towards_camera = mean(moving[i].targets.view_directions).normalized();
    moving[i].taking_part = true;
  }
  return moving;
}

/// All queries of `view`, or one in `stride`, that find the same surface in `other` within `reach`.
void match_pair(const std::vector<MovingView>& views, std::size_t view, std::size_t other,
                double reach, std::size_t stride, std::vector<Match>& matches) {
  const auto& source = views[view];
  const auto& target = views[other];
  const RigidTransform other_from_view = target.correction.inverse() * source.correction;
  for (std::size_t i = 0; i < source.queries.size(); i += stride) {
    const Vector3d normal = other_from_view.linear() * source.queries.normals[i];
    if (normal.dot(target.towards_camera) < kLeastViewCosine) continue;
    const Vector3d point = other_from_view * source.queries.positions[i];
    const auto found = target.index->nearest(point, 1);
    if (found.empty() || found[0].squared_distance > reach * reach) continue;
    const Vector3d& partner = target.targets.positions[found[0].index];
    const Vector3d& partner_normal = target.targets.normals[found[0].index];
    if (normal.dot(partner_normal) < kLeastNormalCosine) continue;
    const Vector3d middle = (normal + partner_normal).normalized();
    const double variance = std::pow(source.queries.sigma_mm[i], 2) +
                            std::pow(target.targets.sigma_mm[found[0].index], 2) +
                            kLeastSigmaMm * kLeastSigmaMm;
    matches.push_back({view, other, target.correction * point, target.correction.linear() * middle,
                       middle.dot(point - partner), variance});
  }
}

std::vector<Match> match_all(const std::vector<MovingView>& views, double reach,
                             std::size_t stride = 1) {
  std::vector<Match> matches;
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (std::size_t other = 0; other < views.size(); ++other) {
      if (view == other || !views[view].taking_part || !views[other].taking_part) continue;
      match_pair(views, view, other, reach, stride, matches);
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

double median_residual(const std::vector<Match>& matches) {
  std::vector<double> distances;
  for (const auto& match : matches) distances.push_back(std::abs(match.distance));
  return median(std::move(distances));
}

/// How far the views lie apart beyond what the noise of their points explains.
double unexplained(const std::vector<Match>& matches) {
  std::vector<double> sigmas;
  std::vector<double> in_sigmas;
  for (const auto& match : matches) {
    sigmas.push_back(std::sqrt(match.variance));
    in_sigmas.push_back(std::abs(match.distance) / sigmas.back());
  }
  const double spread = kSigmaInMedians * median(std::move(in_sigmas));
  return std::sqrt(std::max(0.0, spread * spread - 1.0)) * median(std::move(sigmas));
}

/// One Gauss-Newton step of all poses. How far it moved a point of a foot, at most.
double step(std::vector<MovingView>& views, const std::vector<Match>& matches, double reach,
            const RegistrationSettings& settings) {
  const auto size = static_cast<Eigen::Index>(6 * views.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  const double shared_variance = std::pow(unexplained(matches), 2);
  for (const auto& match : matches) {
    const double variance = kPointsInOne * (match.variance + shared_variance);
    const double weight = tukey(match.distance, reach) / variance;
    if (weight == 0.0) continue;
    const Vector6 a = gradient(views[match.view], match.point, match.normal);
    // The foot of the point on the other's tangent plane: its nearest sample lies aside, and would
    // turn all views together, which changes nothing between them.
    const Vector3d foot = match.point - match.distance * match.normal;
    const Vector6 b = -gradient(views[match.other], foot, match.normal);
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
  if (!solved.allFinite()) return 0.0;
  double furthest_mm = 0.0;
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
    furthest_mm = std::max(furthest_mm, shift.norm() + kArmMm * turn.norm());
  }
  return furthest_mm;
}

/// What the fit took away from the distance of a match.
double taken_away(const std::vector<MovingView>& views, const Match& match) {
  const Vector3d foot = match.point - match.distance * match.normal;
  const Vector3d given = views[match.view].correction.inverse() * match.point -
                         views[match.other].correction.inverse() * foot;
  return match.normal.dot(given) - match.distance;
}

/// How far the i-th step looks. Poses that are off by much are drawn in slowly, so that no view
/// settles on the wrong skin; good ones need not wait for that.
double reach_of_step(int i, double residual_mm, const RegistrationSettings& settings) {
  // The last third stays at the last reach, to settle.
  const double progress = std::min(1.0, 1.5 * i / std::max(1, settings.iterations - 1));
  const double slow = settings.first_reach_mm *
                      std::pow(settings.last_reach_mm / settings.first_reach_mm, progress);
  return std::min(slow, std::max(settings.last_reach_mm, kReachInResiduals * residual_mm));
}

/// Steps with one query in `stride` until the views lie still. False if it was cancelled.
bool settle(std::vector<MovingView>& views, double residual_mm, int first_step, std::size_t stride,
            const RegistrationSettings& settings, const GoOn& go_on) {
  for (int i = first_step; i < settings.iterations; ++i) {
    const double reach = reach_of_step(i, residual_mm, settings);
    const auto matches = match_all(views, reach, stride);
    if (matches.empty()) return true;
    const double moved_mm = step(views, matches, reach, settings);
    residual_mm = median_residual(matches);
    if (!go_on()) return false;
    if (reach <= settings.last_reach_mm && moved_mm < kStillMm) return true;
  }
  return true;
}

double root_mean_square_taken_away(const std::vector<MovingView>& views,
                                   const std::vector<Match>& matches) {
  double squares = 0.0;
  for (const auto& match : matches) squares += std::pow(taken_away(views, match), 2);
  return matches.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(matches.size()));
}

/// The given poses are as well known as the overlaps of the views show, and no worse where no
/// overlap shows it: there, a loose pose would follow what the noise of an overlap makes of it.
RegistrationSettings with_likely_poses(const std::vector<MovingView>& views,
                                       const RegistrationSettings& settings) {
  const auto matches = match_all(views, settings.last_reach_mm, kCoarseStride);
  const double off_mm = kLikelyErrors * root_mean_square_taken_away(views, matches) + kLeastPoseMm;
  RegistrationSettings likely = settings;
  likely.pose_sigma_mm = std::min(settings.pose_sigma_mm, off_mm);
  likely.pose_sigma_deg = std::min(settings.pose_sigma_deg, off_mm / kArmMm / kDegree);
  return likely;
}

/// First roughly, then by what that says of the poses. False if it was cancelled.
bool solve(std::vector<MovingView>& views, const RegistrationSettings& settings,
           const GoOn& go_on) {
  for (auto& view : views) view.correction = RigidTransform::Identity();
  const double residual_mm =
      median_residual(match_all(views, settings.first_reach_mm, kCoarseStride));
  if (!settle(views, residual_mm, 0, kCoarseStride, settings, go_on)) return false;
  for (const std::size_t stride : {kCoarseStride, kCoarseStride, kFineStride}) {
    const auto likely = with_likely_poses(views, settings);
    const int first_step = settings.iterations - kLastSteps;
    if (!settle(views, 0.0, first_step, stride, likely, go_on)) return false;
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
  std::vector<Match> own;
  for (const auto& match : matches) {
    if (match.view != at) continue;
    own.push_back(match);
    distances.push_back(std::abs(match.distance));
    if (matched.empty() || matched.back() != match.point) matched.push_back(match.point);
  }
  judged.overlap = static_cast<double>(matched.size()) / static_cast<double>(view.queries.size());
  judged.taken_away_mm = root_mean_square_taken_away(views, own);
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
  const auto given = match_all(moving, settings.first_reach_mm);
  registration.residual_before_mm = median_residual(given);
  registration.unexplained_before_mm = unexplained(given);
  for (std::size_t round = 0; round <= views.size(); ++round) {
    if (!solve(moving, settings, go_on)) return cancelled();
    const auto matches = match_all(moving, 2.0 * settings.last_reach_mm);
    registration.residual_after_mm = median_residual(matches);
    registration.unexplained_after_mm = unexplained(matches);
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
