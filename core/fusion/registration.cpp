#include "core/fusion/registration.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fusion/view_matches.h"
#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kDegree = std::numbers::pi / 180.0;
/// Neighbouring points share most of their error: so many count as one against the given poses.
constexpr double kPointsInOne = 30.0;
constexpr double kArmMm = 150.0;  // from the middle of a foot to its ends
constexpr double kStillMm = 0.01;
/// While the views move much, one query in so many will do.
constexpr std::size_t kCoarseStride = 4;
constexpr std::size_t kFineStride = 1;
constexpr int kLastSteps = 4;  // at most, each time that more is known of the poses
/// Where the views lie as still as this at one reach, the next one is half of it. Set by eye.
constexpr double kSettledMm = 0.3;
constexpr double kLeastPoseMm = 1e-3;
/// Least eigenvalue of the mean of n n^T over the matches of a view that cannot slide: over two
/// cameras that share the platform alone up to 0.0009, over those that share skin 0.0018 to 0.04.
constexpr double kLeastHold = 0.0015;

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

/// Turns and shifts each view about its centroid. How far that moves a point of a foot, at most.
double move(std::vector<MovingView>& views, const Eigen::VectorXd& turns_and_shifts) {
  double furthest_mm = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Vector3d turn = turns_and_shifts.segment<3>(static_cast<Eigen::Index>(6 * i));
    const Vector3d shift = turns_and_shifts.segment<3>(static_cast<Eigen::Index>(6 * i + 3));
    const Vector3d centre = corrected_centroid(views[i]);
    RigidTransform own = RigidTransform::Identity();
    if (turn.norm() > 0.0) {
      own.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    }
    own.translation() = centre + shift - own.linear() * centre;
    views[i].correction = own * views[i].correction;
    furthest_mm = std::max(furthest_mm, shift.norm() + kArmMm * turn.norm());
  }
  return furthest_mm;
}

/// One Gauss-Newton step of all poses. How far it moved a point of a foot, at most.
double step(std::vector<MovingView>& views, const std::vector<ViewMatch>& matches, double reach,
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
  return solved.allFinite() ? move(views, solved) : 0.0;
}

/// Draws the views together. Poses that are off by much are drawn in slowly, so that no view
/// settles on the wrong skin, and the reach is never small before they have settled with a large
/// one: the platform alone lies still at once, and may be most of what is matched. False if
/// cancelled.
bool draw_together(std::vector<MovingView>& views, const RegistrationSettings& settings,
                   const GoOn& go_on) {
  const double slowly = std::pow(settings.last_reach_mm / settings.first_reach_mm,
                                 1.5 / std::max(1, settings.iterations - 1));
  double reach = settings.first_reach_mm;
  for (int i = 0; i < settings.iterations; ++i) {
    const auto matches = match_views(views, reach, kCoarseStride);
    if (matches.empty()) return true;
    const double moved_mm = step(views, matches, reach, settings);
    if (!go_on()) return false;
    if (reach <= settings.last_reach_mm && moved_mm < kStillMm) return true;
    reach = std::max(settings.last_reach_mm, reach * (moved_mm < kSettledMm ? 0.5 : slowly));
  }
  return true;
}

/// The given poses are as well known as the overlaps of the views show, and no worse where no
/// overlap shows it: there, a loose pose would follow what the noise of an overlap makes of it.
RegistrationSettings with_likely_poses(const std::vector<MovingView>& views,
                                       const RegistrationSettings& settings) {
  const auto matches = match_views(views, settings.last_reach_mm, kCoarseStride);
  const double off_mm = std::max(kLeastPoseMm, taken_away(views, matches));
  RegistrationSettings likely = settings;
  likely.pose_sigma_mm = std::min(settings.pose_sigma_mm, off_mm);
  likely.pose_sigma_deg = std::min(settings.pose_sigma_deg, off_mm / kArmMm / kDegree);
  return likely;
}

/// A few steps with the last reach. False if cancelled.
bool settle(std::vector<MovingView>& views, std::size_t stride,
            const RegistrationSettings& settings, const GoOn& go_on) {
  for (int i = 0; i < kLastSteps; ++i) {
    const auto matches = match_views(views, settings.last_reach_mm, stride);
    if (matches.empty()) return true;
    const double moved_mm = step(views, matches, settings.last_reach_mm, settings);
    if (!go_on()) return false;
    if (moved_mm < kStillMm) return true;
  }
  return true;
}

/// First roughly, then by what that says of the poses. False if cancelled.
bool solve(std::vector<MovingView>& views, const RegistrationSettings& settings,
           const GoOn& go_on) {
  for (auto& view : views) view.correction = RigidTransform::Identity();
  if (!draw_together(views, settings, go_on)) return false;
  for (const std::size_t stride : {kCoarseStride, kCoarseStride, kFineStride}) {
    if (!settle(views, stride, with_likely_poses(views, settings), go_on)) return false;
  }
  return true;
}

/// Whether a view could slide along all that it shares with others.
bool can_slide(const std::vector<ViewMatch>& matches) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& match : matches) sum += match.normal * match.normal.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum, Eigen::EigenvaluesOnly);
  return !(solver.eigenvalues()(0) >= kLeastHold * static_cast<double>(matches.size()));
}

/// Of its queries, by however many views each.
double share_matched(const MovingView& view, const std::vector<ViewMatch>& own) {
  std::vector<bool> is_matched(view.queries.size(), false);
  for (const auto& match : own) is_matched[match.query] = true;
  return static_cast<double>(std::count(is_matched.begin(), is_matched.end(), true)) /
         static_cast<double>(is_matched.size());
}

RegisteredView judge(const std::vector<MovingView>& views, std::size_t at,
                     const std::vector<ViewMatch>& all, const RegistrationSettings& settings) {
  RegisteredView judged;
  const auto& view = views[at];
  if (!view.taking_part) return judged;
  const auto own = matches_of(at, all);
  judged.overlap = share_matched(view, own);
  judged.taken_away_mm = taken_away(views, own);
  judged.residual_mm = median_residual(own);
  judged.correction = view.correction;
  const double shift = (corrected_centroid(view) - view.centroid).norm();
  const double turn = Eigen::AngleAxisd(view.correction.linear()).angle();
  judged.moved_mm = shift + kArmMm * turn;
  const bool too_far = shift > settings.most_shift_mm || turn > settings.most_turn_deg * kDegree;
  if (too_far || judged.residual_mm > settings.most_residual_mm) {
    judged.fit = ViewFit::kDoesNotFit;
  } else if (judged.overlap >= settings.least_overlap) {
    judged.fit = can_slide(own) ? ViewFit::kSlides : ViewFit::kFits;
  }
  return judged;
}

}  // namespace

Result<Registration> register_views(const std::vector<PointCloud>& views,
                                    const RegistrationSettings& settings, const GoOn& go_on) {
  auto moving = moving_views(views, settings.queries, settings.targets);
  Registration registration;
  registration.views.resize(views.size());
  const auto given = match_views(moving, 2.0 * settings.last_reach_mm);
  registration.residual_before_mm = median_residual(given);
  registration.unexplained_before_mm = unexplained(given);
  for (std::size_t round = 0; round <= views.size(); ++round) {
    if (!solve(moving, settings, go_on)) return cancelled();
    const auto matches = match_views(moving, 2.0 * settings.last_reach_mm);
    registration.residual_after_mm = median_residual(matches);
    registration.unexplained_after_mm = unexplained(matches);
    std::size_t worst = views.size();
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (!moving[i].taking_part) continue;
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
