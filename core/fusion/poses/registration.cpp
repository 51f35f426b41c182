#include "core/fusion/poses/registration.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/degree.h"
#include "core/fusion/poses/view_equations.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kFirstReachMm = 30.0;  // how far apart matching surfaces may be at the beginning
constexpr double kLastReachMm = 5.0;    // and at the end
constexpr int kIterations = 40;
constexpr std::size_t kTargets = 10000;  // points of a view that can be matched
constexpr double kMostTurnDeg = 12.0;    // a view that wants to turn further does not fit
constexpr double kMostStretch = 0.015;   // nor does one that is to grow or shrink by more
constexpr double kStillMm = 0.01;
/// While the views move much, one query in so many will do.
constexpr std::size_t kCoarseStride = 4;
constexpr std::size_t kFineStride = 1;
/// At most, each time that more is known of the views; where nothing but the overlaps holds them,
/// they slide to their places in many small steps.
constexpr int kLastSteps = 4;
constexpr int kLastStepsOfRough = 100;
/// Where the views lie as still as this at one reach, the next one is half of it. Set by eye.
constexpr double kSettledMm = 0.3;
constexpr double kLeastPoseMm = 1e-3;
/// However well or ill the overlaps fit, lenses are not taken for better or worse. Set by eye.
constexpr double kLeastLens = 5e-4;
constexpr double kMostLens = 1e-2;
/// How often what the stretches are likely to be is told anew by what it makes of them.
constexpr int kLensRounds = 3;
/// Least eigenvalue of the mean of n n^T over the matches of a view that cannot slide: over two
/// cameras that share the platform alone up to 0.0009, over those that share skin 0.0018 to 0.04.
constexpr double kLeastHold = 0.0015;

/// One Gauss-Newton step of all views. How far it moved a point of a foot, at most.
double step(std::vector<MovingView>& views, const std::vector<ViewMatch>& matches, double reach,
            const ExpectedErrors& expected) {
  auto equations = equations_of(views, matches, reach);
  add_expected(expected, views, equations);
  const Eigen::VectorXd solved = equations.matrix.ldlt().solve(equations.right);
  return solved.allFinite() ? move_by(solved, views) : 0.0;
}

/// Draws the views together. Poses that are off by much are drawn in slowly, so that no view
/// settles on the wrong skin, and the reach is never small before they have settled with a large
/// one: the platform alone lies still at once, and may be most of what is matched. False if
/// cancelled.
bool draw_together(std::vector<MovingView>& views, const RegistrationSettings& settings,
                   const GoOn& go_on) {
  const double slowly = std::pow(kLastReachMm / kFirstReachMm, 1.5 / (kIterations - 1));
  double reach = kFirstReachMm;
  for (int i = 0; i < kIterations; ++i) {
    const auto matches = match_views(views, reach, kCoarseStride);
    if (matches.empty()) return true;
    const double moved_mm = step(views, matches, reach, settings.expected);
    if (!go_on()) return false;
    if (reach <= kLastReachMm && moved_mm < kStillMm) return true;
    reach = std::max(kLastReachMm, reach * (moved_mm < kSettledMm ? 0.5 : slowly));
  }
  return true;
}

/// What is left unknown of the views: the covariance of their unknowns.
Eigen::MatrixXd covariance_of(NormalEquations equations, const ExpectedErrors& expected,
                              const std::vector<MovingView>& views) {
  add_expected(expected, views, equations);
  const Eigen::MatrixXd all =
      Eigen::MatrixXd::Identity(equations.matrix.rows(), equations.matrix.cols());
  return equations.matrix.ldlt().solve(all);
}

/// Of the stretches as found, and of what may be left of them, root mean square.
double likely_lens(const std::vector<MovingView>& views, const Eigen::MatrixXd& covariance) {
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!views[i].taking_part) continue;
    const Eigen::Index at = first_unknown(i);
    squares += std::pow(views[i].deeper, 2) + covariance(at + 6, at + 6);
    squares += std::pow(views[i].wider, 2) + covariance(at + 7, at + 7);
    count += 2.0;
  }
  return std::clamp(std::sqrt(squares / count), kLeastLens, kMostLens);
}

/// The given poses and lenses are as well known as the overlaps of the views show, and poses no
/// worse where no overlap shows it: there, a loose one would follow what the noise of an overlap
/// makes of it.
ExpectedErrors likely_errors(const std::vector<MovingView>& views,
                             const RegistrationSettings& settings) {
  ExpectedErrors likely = settings.expected;
  const auto matches = match_views(views, kLastReachMm, kCoarseStride);
  if (!settings.are_poses_rough) {
    const double off_mm = std::max(kLeastPoseMm, taken_away(views, matches));
    likely.pose_mm = std::min(likely.pose_mm, off_mm);
    likely.pose_deg = std::min(likely.pose_deg, off_mm / kArmMm / kDegree);
  }
  if (matches.empty() || likely.lens == 0.0) return likely;
  const auto equations = equations_of(views, matches, kLastReachMm);
  for (int i = 0; i < kLensRounds; ++i) {
    likely.lens = likely_lens(views, covariance_of(equations, likely, views));
  }
  return likely;
}

/// A few steps with the last reach. False if cancelled.
bool settle(std::vector<MovingView>& views, std::size_t stride, const ExpectedErrors& expected,
            const RegistrationSettings& settings, const GoOn& go_on) {
  const double reach = kLastReachMm;
  const int steps = settings.are_poses_rough ? kLastStepsOfRough : kLastSteps;
  for (int i = 0; i < steps; ++i) {
    const auto matches = match_views(views, reach, stride);
    if (matches.empty()) return true;
    const double moved_mm = step(views, matches, reach, expected);
    if (!go_on()) return false;
    if (moved_mm < kStillMm) return true;
  }
  return true;
}

/// First roughly, then by what that says of poses and lenses. False if cancelled.
bool solve(std::vector<MovingView>& views, const RegistrationSettings& settings,
           const GoOn& go_on) {
  for (auto& view : views) {
    view.pose_correction = RigidTransform::Identity();
    view.deeper = view.wider = 0.0;
  }
  if (!draw_together(views, settings, go_on)) return false;
  for (const std::size_t stride : {kCoarseStride, kCoarseStride, kFineStride}) {
    const auto likely = likely_errors(views, settings);
    if (!settle(views, stride, likely, settings, go_on)) return false;
  }
  return true;
}

/// The pose's part, where the view is stretched about its camera in place of its centroid.
RigidTransform correction_after_stretch(const MovingView& view) {
  const Vector3d from_camera = view.centroid - view.station_from_camera.translation();
  RigidTransform back = RigidTransform::Identity();
  back.translation() = from_camera - view.stretch() * from_camera;
  return view.pose_correction * back;
}

/// What the matches and what is known beforehand leave open, as independent errors of all views.
void tell_errors(const std::vector<MovingView>& views, const std::vector<ViewMatch>& matches,
                 const RegistrationSettings& settings, Registration& registration) {
  auto equations = equations_of(views, matches, kLastReachMm);
  if (settings.normal_variance > 0.0) {
    take_out_noise_of_normals(settings.normal_variance, views, matches, kLastReachMm, equations);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      covariance_of(equations, likely_errors(views, settings), views));
  if (solver.info() != Eigen::Success) return;
  const Eigen::MatrixXd errors =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  for (std::size_t i = 0; i < views.size(); ++i) {
    auto& view = registration.views[i];
    if (views[i].queries.empty() || view.fit == ViewFit::kDoesNotFit) continue;
    const RigidTransform camera_from_station =
        (view.correction * views[i].station_from_camera).inverse();
    for (Eigen::Index e = 0; e < errors.cols(); ++e) {
      const UnknownsVector off = errors.col(e).segment<kUnknowns>(first_unknown(i));
      view.errors.push_back(in_frame(camera_from_station, error_field(views[i], off)));
    }
  }
}

/// Whether a view could slide along all that it shares with others.
bool can_slide(const std::vector<ViewMatch>& matches) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& match : matches) sum += match.normal * match.normal.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum, Eigen::EigenvaluesOnly);
  return matches.empty() ||
         !(solver.eigenvalues()(0) >= kLeastHold * static_cast<double>(matches.size()));
}

/// Of its queries, by however many views each.
double share_matched(const MovingView& view, const std::vector<ViewMatch>& own) {
  std::vector<bool> is_matched(view.queries.size(), false);
  for (const auto& match : own) is_matched[match.query] = true;
  return static_cast<double>(std::count(is_matched.begin(), is_matched.end(), true)) /
         static_cast<double>(is_matched.size());
}

/// The largest share of another view's queries that it matches.
double share_of_others_matched(const std::vector<MovingView>& views, std::size_t at,
                               const std::vector<ViewMatch>& all) {
  std::vector<std::size_t> matched(views.size(), 0);
  for (const auto& match : all) {
    if (match.other == at) ++matched[match.view];
  }
  double most = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (matched[i] == 0) continue;
    most = std::max(most,
                    static_cast<double>(matched[i]) / static_cast<double>(views[i].queries.size()));
  }
  return most;
}

/// How near a view is to the limits within which it fits; over 1 is beyond.
double strain(const MovingView& view, double residual_mm, const RegistrationSettings& settings) {
  const double shift = (view.corrected_centroid() - view.centroid).norm();
  const double turn = Eigen::AngleAxisd(view.pose_correction.linear()).angle();
  const double stretch = std::max(std::abs(view.deeper), std::abs(view.wider));
  return std::max({shift / settings.most_shift_mm, turn / (kMostTurnDeg * kDegree),
                   stretch / kMostStretch, residual_mm / settings.most_residual_mm});
}

RegisteredView judge(const std::vector<MovingView>& views, std::size_t at,
                     const std::vector<ViewMatch>& all, const RegistrationSettings& settings) {
  RegisteredView judged;
  const auto& view = views[at];
  const auto own = matches_of(at, all);
  judged.overlap = share_matched(view, own);
  judged.taken_away_mm = taken_away(views, own);
  judged.residual_mm = median_residual(own);
  judged.deeper = view.deeper;
  judged.wider = view.wider;
  judged.correction = correction_after_stretch(view);
  judged.unstretched_correction = view.pose_correction;
  judged.moved_mm = (view.corrected_centroid() - view.centroid).norm() +
                    kArmMm * Eigen::AngleAxisd(view.pose_correction.linear()).angle();
  const double shared = std::max(judged.overlap, share_of_others_matched(views, at, all));
  if (strain(view, judged.residual_mm, settings) > 1.0) {
    judged.fit = ViewFit::kDoesNotFit;
  } else if (shared >= settings.least_overlap) {
    judged.fit = can_slide(own) ? ViewFit::kSlides : ViewFit::kFits;
  }
  return judged;
}

/// Of the views that take part and should not, the one that fits worst; where all fit, the one of
/// those that are alone that shares least, unless it is the last.
std::optional<std::size_t> worst_of(const Registration& registration,
                                    const std::vector<MovingView>& views,
                                    const RegistrationSettings& settings) {
  std::optional<std::size_t> worst;
  std::optional<std::size_t> alone;
  double most = 0.0;
  std::size_t taking_part = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!views[i].taking_part) continue;
    ++taking_part;
    const auto& view = registration.views[i];
    const double own = strain(views[i], view.residual_mm, settings);
    if (view.fit == ViewFit::kDoesNotFit && own > most) {
      most = own;
      worst = i;
    }
    if (view.fit != ViewFit::kAlone) continue;
    if (!alone || view.overlap < registration.views[*alone].overlap) alone = i;
  }
  return worst || taking_part < 2 ? worst : alone;
}

}  // namespace

Result<Registration> register_views(const std::vector<PosedCloud>& views,
                                    const RegistrationSettings& settings, const GoOn& go_on) {
  auto moving = moving_views(views, settings.queries, kTargets);
  Registration registration;
  registration.views.resize(views.size());
  if (views.empty()) return registration;
  const auto given = match_views(moving, 2.0 * kLastReachMm);
  registration.residual_before_mm = median_residual(given);
  registration.unexplained_before_mm = unexplained(given);
  registration.residual_after_mm = registration.residual_before_mm;
  registration.unexplained_after_mm = registration.unexplained_before_mm;
  for (std::size_t round = 0; round <= views.size(); ++round) {
    if (!solve(moving, settings, go_on)) return cancelled();
    const auto matches = match_views(moving, 2.0 * kLastReachMm);
    if (!matches.empty()) {  // else nothing tells how they lie now
      registration.residual_after_mm = median_residual(matches);
      registration.unexplained_after_mm = unexplained(matches);
    }
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (moving[i].taking_part) registration.views[i] = judge(moving, i, matches, settings);
    }
    const auto worst = worst_of(registration, moving, settings);
    if (!worst) {
      registration.bent = bent_depths(moving, matches);
      tell_errors(moving, matches, settings, registration);
      break;
    }
    // One at a time: a bad view spoils its neighbours.
    moving[*worst].taking_part = false;
    auto& out = registration.views[*worst];
    out.correction = out.unstretched_correction = RigidTransform::Identity();
    out.deeper = out.wider = out.moved_mm = out.taken_away_mm = 0.0;
  }
  return registration;
}

}  // namespace instep
