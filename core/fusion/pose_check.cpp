#include "core/fusion/pose_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/fusion/frames/lens.h"
#include "core/fusion/poses/registration.h"
#include "core/fusion/station_region.h"
#include "core/in_millimetres.h"
#include "core/in_percent.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr int kPoseStride = 2;  // every so many pixels, both ways
/// Poses that are off by less across the skin are right: by right poses the fit took 0.04 mm at
/// most from the distances of a view, in 32 scans of simulated feet, half of them by bad sensors.
constexpr double kDisagreementMm = 0.1;
/// With the noise of a bad sensor and poses that are off by half a millimetre, 0.27 at most were
/// left of 12 simulated feet; of real feet and a hand-held camera 1.2.
constexpr double kWorthSayingMm = 0.5;
/// From here on somebody should hear that the poses had to be refined.
constexpr double kWorthMendingMm = 0.5;
/// Poses are judged by one of so many of the points that refine them.
constexpr std::size_t kPartToJudgeBy = 4;

/// Fits the surfaces of the views to each other. To judge poses that are trusted, a part of the
/// points will do.
Result<Registration> fit_to_each_other(const std::vector<WorkingView>& views,
                                       const FusionSettings& settings, const GoOn& go_on) {
  std::vector<PosedCloud> clouds;
  for (const auto& view : views) {
    std::vector<std::uint32_t> pixels;
    visit_pixels(view, kPoseStride, [&](std::size_t pixel, const Vector3d& point) {
      if (in_region(point, settings)) pixels.push_back(static_cast<std::uint32_t>(pixel));
    });
    clouds.push_back({station_cloud(view, pixels), view.station_from_camera});
  }
  RegistrationSettings registering;
  if (!settings.refine_views) {
    registering.queries /= kPartToJudgeBy;
    registering.expected.lens = 0.0;  // or part of what poses are off by would be taken for theirs
  }
  return register_views(clouds, registering, go_on);
}

/// Makes depths and what lies across them larger by these shares. Fails with the lens alone.
Result<void> stretch(double deeper, double wider, WorkingView& view) {
  if (deeper == 0.0 && wider == 0.0) return {};
  const double factor = (1.0 + wider) / (1.0 + deeper);
  auto rays = Deprojector::create(widened(view.rays->intrinsics(), factor));
  if (!rays) {
    Error error = rays.error();
    error.message = "camera " + view.id + ": " + error.message;
    return tl::make_unexpected(error);
  }
  view.rays = std::make_shared<const Deprojector>(*std::move(rays));
  for (float& depth : view.depth.depth_mm) depth *= static_cast<float>(1.0 + deeper);
  return {};
}

/// Stretches and moves the views to where they fit, and drops those that do not.
Result<void> move_to_fit(const Registration& registration, const Workers& workers,
                         std::vector<WorkingView>& views) {
  std::vector<std::optional<Result<void>>> stretched(views.size());
  workers(views.size(), [&](std::size_t i) {
    stretched[i] = stretch(registration.views[i].deeper, registration.views[i].wider, views[i]);
  });
  for (const auto& done : stretched) {
    if (!*done) return tl::make_unexpected(done->error());
  }
  std::vector<WorkingView> fitting;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto& registered = registration.views[i];
    if (registered.fit == ViewFit::kDoesNotFit) continue;
    views[i].station_from_camera = registered.correction * views[i].station_from_camera;
    views[i].errors = registered.errors;
    fitting.push_back(std::move(views[i]));
  }
  views = std::move(fitting);
  return {};
}

/// Which views do not fit, and which ones' poses nothing proves.
void warn_of_unproven_poses(const Registration& registration, const std::vector<WorkingView>& views,
                            bool are_refined, FusedScene& scene) {
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::string camera = "camera " + views[i].id;
    switch (registration.views[i].fit) {
      case ViewFit::kFits:
        break;
      case ViewFit::kDoesNotFit:
        scene.warnings.push_back(camera + " does not agree with the others" +
                                 (are_refined ? " and was left out" : "") +
                                 ": see to its pose and its lens, and that nothing is before it");
        break;
      case ViewFit::kSlides:
        scene.warnings.push_back(camera +
                                 " shares with the others only what it could slide along, such as "
                                 "the platform: its pose is not checked, and no interval knows of "
                                 "it; let another camera see the skin between");
        break;
      case ViewFit::kAlone:
        if (views.size() < 2) break;
        scene.warnings.push_back(
            camera +
            " shares no surface with the others: its pose is not checked, and taken to be as right "
            "as theirs; let another camera see the skin between");
    }
  }
}

/// One camera that is off makes all others seem so: the one that has to move furthest is named.
void warn_of_wrong_poses(const Registration& registration, const std::vector<WorkingView>& views,
                         bool are_refined, FusedScene& scene) {
  double& off_mm = scene.diagnostics.poses_off_mm;
  std::optional<std::size_t> furthest;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto& view = registration.views[i];
    if (view.fit == ViewFit::kDoesNotFit) continue;  // which is said of it
    off_mm = std::max(off_mm, view.taken_away_mm);
    if (!furthest || view.moved_mm > registration.views[*furthest].moved_mm) furthest = i;
  }
  if (!furthest || off_mm < (are_refined ? kWorthMendingMm : kDisagreementMm)) return;
  scene.warnings.push_back(
      "by the given poses, camera " + views[*furthest].id + " before others, the same skin lies " +
      in_millimetres(off_mm) + " apart in two views: " +
      (are_refined ? "they were refined; if they should be right, a camera was moved, or its lens "
                     "or depth is off: calibrate the station (instep calibrate)"
                   : "no interval knows of that; let them be refined (refine_views = true in the "
                     "settings, --poses refine)"));
}

/// The camera whose lens or depth seems to be off by most.
void warn_of_wrong_lenses(const Registration& registration, const std::vector<WorkingView>& views,
                          FusedScene& scene) {
  double off = 0.0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto& view = registration.views[i];
    const double own = std::max(std::abs(view.deeper), std::abs(view.wider));
    if (own <= off) continue;
    off = own;
    worst = i;
  }
  scene.diagnostics.lenses_off = off;
  if (off < kNotableStretch) return;
  scene.warnings.push_back("what camera " + views[worst].id + " sees seems to come out wrong by " +
                           in_percent(off) +
                           " of its size: it was corrected as far as the other cameras tell; "
                           "calibrate its lens and its depth");
}

/// What no pose and no lens explains: the intervals count it in.
void warn_of_the_unexplained(const Registration& registration, FusedScene& scene) {
  if (registration.unexplained_after_mm < kWorthSayingMm) return;
  scene.warnings.push_back("what two cameras see of the same skin lies " +
                           in_millimetres(registration.unexplained_after_mm) +
                           " apart, however they are fitted to each other, and the intervals are "
                           "the wider for it: calibrate their depths, ask the customer to stand "
                           "still, or take more frames");
}

}  // namespace

Result<void> check_poses(const FusionSettings& settings, const Workers& workers, const GoOn& go_on,
                         std::vector<WorkingView>& views, FusedScene& scene) {
  const auto registration = fit_to_each_other(views, settings, go_on);
  if (!registration) return tl::make_unexpected(registration.error());
  const bool are_refined = settings.refine_views;
  warn_of_unproven_poses(*registration, views, are_refined, scene);
  warn_of_wrong_poses(*registration, views, are_refined, scene);
  if (are_refined) warn_of_wrong_lenses(*registration, views, scene);
  warn_of_the_unexplained(*registration, scene);
  auto& figures = scene.diagnostics;
  figures.registration_before_mm = registration->residual_before_mm;
  figures.registration_after_mm =
      are_refined ? registration->residual_after_mm : registration->residual_before_mm;
  figures.bent = registration->bent;
  figures.unexplained_mm =
      are_refined ? registration->unexplained_after_mm : registration->unexplained_before_mm;
  return are_refined ? move_to_fit(*registration, workers, views) : Result<void>{};
}

}  // namespace instep
