#include "core/fusion/fuse_views.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "core/fusion/foot_points.h"
#include "core/fusion/outliers.h"
#include "core/fusion/pose_check.h"
#include "core/fusion/poses/platform.h"
#include "core/fusion/separate_feet.h"
#include "core/fusion/sole/close_sole.h"
#include "core/fusion/station_region.h"
#include "core/fusion/views/overruled.h"
#include "core/fusion/views/thin.h"
#include "core/fusion/views/working_view.h"
#include "core/geometry/plane_vectors.h"
#include "core/in_millimetres.h"
#include "core/in_percent.h"
#include "core/mean.h"
#include "core/median.h"
#include "core/noticed.h"
#include "core/while_wanted.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr int kPlatformStride = 3;      // every so many pixels, both ways, for finding the platform
constexpr double kLowestShare = 0.002;  // of a scene's points below which they are taken for noise
constexpr std::size_t kSectors = 72;
// Of what one view saw of the feet, what others see through. By poses that fit it is 0.0002 at the
// most in simulated scans, 0.07 in a real one; where a view that shares no skin with others is
// turned by 20 to 180 degrees, shifted by 80 mm or swapped, 0.5 and more of one.
constexpr double kMostSeenThrough = 0.3;
constexpr std::size_t kClearlySeenThrough = 100;  ///< points
constexpr double kLeastCoverage = 0.9;

/// Who does the work, and who is told of it.
struct Work {
  const Workers& workers;
  const GoOn& go_on;

  /// A job for each view; false if the work was cancelled, when some are not done.
  bool for_each_view(std::size_t count, const std::function<void(std::size_t)>& job) const {
    std::atomic<bool> wanted = true;
    while_wanted(workers, go_on, wanted)(count, job);
    return wanted;
  }
};

/// By name: where points are thinned or matched some go before others, which must not hang on which
/// camera spoke first.
std::vector<const View*> in_order(const std::vector<View>& views) {
  std::vector<const View*> ordered;
  for (const auto& view : views) ordered.push_back(&view);
  std::stable_sort(ordered.begin(), ordered.end(), [](const View* one, const View* other) {
    return one->geometry.id < other->geometry.id;
  });
  return ordered;
}

/// Checks and cleans each view; the first that is not sound fails all.
Result<std::vector<WorkingView>> open_views(const std::vector<const View*>& views,
                                            const Work& work) {
  std::vector<std::optional<Result<WorkingView>>> opened(views.size());
  const bool done =
      work.for_each_view(views.size(), [&](std::size_t i) { opened[i] = open_view(*views[i]); });
  if (!done) return cancelled();
  std::vector<WorkingView> working;
  for (auto& view : opened) {
    if (!*view) return tl::make_unexpected(view->error());
    working.push_back(std::move(**view));
  }
  return working;
}

/// Drops the views in which nothing is left, with a warning each.
void drop_blind_views(std::vector<WorkingView>& views, const FusionSettings& settings,
                      FusedScene& scene) {
  std::erase_if(views, [&](const WorkingView& view) {
    bool sees = false;
    visit_pixels(view, kPlatformStride, [&](std::size_t, const Vector3d& point) {
      sees = sees || in_region(point, settings);
    });
    if (sees) return false;
    scene.warnings.push_back("camera " + view.id + " saw nothing near the platform");
    return true;
  });
}

/// Finds the platform and turns the station until it is level. Without one the given height or the
/// lowest points stand for it.
void find_standing_plane(std::vector<WorkingView>& views, const FusionSettings& settings,
                         FusedScene& scene) {
  std::vector<Vector3d> points;
  for (const auto& view : views) {
    visit_pixels(view, kPlatformStride, [&](std::size_t, const Vector3d& point) {
      if (in_region(point, settings)) points.push_back(point);
    });
  }
  PlatformSettings search;
  search.expected_height_mm = settings.platform_height_mm;
  if (const auto platform = find_platform(points, search)) {
    scene.diagnostics.platform_found = true;
    scene.diagnostics.platform_tilt_deg =
        std::acos(std::min(1.0, platform->normal.z())) * 180.0 / std::numbers::pi;
    scene.standing_height_mm = platform->height_mm();
    const RigidTransform level = platform->level_from_station();
    for (auto& view : views) view.station_from_camera = level * view.station_from_camera;
    return;
  }
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.z() < b.z(); });
  if (points.empty()) return;
  const auto lowest = static_cast<std::size_t>(kLowestShare * static_cast<double>(points.size()));
  scene.standing_height_mm = settings.platform_height_mm.value_or(points[lowest].z());
}

/// Where views disagree, keeps the better founded one. False if cancelled.
bool drop_overruled(const std::vector<WorkingView>& views, const Work& work,
                    std::vector<FootPoints>& found) {
  std::vector<SeenSurface> surfaces(views.size());
  std::vector<std::vector<std::size_t>> kept(views.size());
  const bool looked = work.for_each_view(views.size(), [&](std::size_t i) {
    surfaces[i] = seen_surface(views[i].posed(), found[i].points.cloud);
  });
  const bool voted = looked && work.for_each_view(views.size(), [&](std::size_t i) {
    kept[i] = points_not_overruled(surfaces, i);
  });
  if (!voted) return false;
  for (std::size_t i = 0; i < views.size(); ++i) {
    found[i].points = subset(found[i].points, kept[i]);
  }
  return true;
}

/// The view that others contradict most, if any: where it saw the feet, they see through.
struct Contradiction {
  std::string camera;
  double share = 0.0;     ///< of what it saw of the feet
  std::size_t views = 0;  ///< that were asked: of two, nobody knows which one errs
};

std::optional<Contradiction> contradiction_of(const std::vector<WorkingView>& views,
                                              const std::vector<FootPoints>& found) {
  std::optional<Contradiction> worst;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (found[i].seen_through < kClearlySeenThrough) continue;
    const auto denied = static_cast<double>(found[i].seen_through);
    const double share = denied / (denied + static_cast<double>(found[i].points.cloud.size()));
    if (share > (worst ? worst->share : kMostSeenThrough))
      worst = {views[i].id, share, views.size()};
  }
  return worst;
}

Error contradicted(const Contradiction& contradiction) {
  return fail(ErrorCode::kInsufficientData,
              "the cameras contradict each other: others see through " +
                  in_percent(contradiction.share) + " of what camera " + contradiction.camera +
                  " saw of the feet",
              "scan again, and keep still; where that does not help, a camera was moved, or has "
              "another one's pose: calibrate the station (instep calibrate)")
      .value();
}

/// The points of the feet, of all views. Fails if these contradict each other, and says so.
Result<ViewedCloud> gather_feet(const std::vector<WorkingView>& views,
                                const FusionSettings& settings, const Work& work, FusedScene& scene,
                                std::optional<Contradiction>& contradiction) {
  std::vector<FootPoints> found(views.size());
  const bool done = work.for_each_view(
      views.size(), [&](std::size_t i) { found[i] = foot_points(views, i, settings, scene); });
  if (!done) return cancelled();
  contradiction = contradiction_of(views, found);
  if (contradiction) return tl::make_unexpected(contradicted(*contradiction));
  if (!drop_overruled(views, work, found)) return cancelled();
  ViewedCloud gathered;
  for (const auto& [points, seen_through] : found) {
    gathered.cloud.append(points.cloud);
    gathered.views.insert(gathered.views.end(), points.views.begin(), points.views.end());
  }
  return gathered;
}

void drop_outliers(ViewedCloud& points) {
  points = subset(points, crowded_points(points.cloud));
  points = subset(points, clustered_points(points.cloud));
}

/// Share of the directions round the middle of a foot in which its wall was seen.
double coverage_of(const PointCloud& foot) {
  const auto middle = mean_of(
      foot.positions, [](const Vector3d& point) -> Eigen::Vector2d { return point.head<2>(); });
  std::vector<bool> seen(kSectors, false);
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const Eigen::Vector2d outward = foot.positions[i].head<2>() - middle;
    if (std::abs(foot.normals[i].z()) > 0.8 || outward.dot(foot.normals[i].head<2>()) < 0.0)
      continue;
    seen[sector_of(outward, kSectors)] = true;
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) / kSectors;
}

std::vector<ViewedCloud> pick_feet(const ViewedCloud& points, FusedScene& scene) {
  const auto separated = separate_feet(points.cloud.positions, scene.standing_height_mm);
  scene.warnings.insert(scene.warnings.end(), separated.warnings.begin(), separated.warnings.end());
  std::vector<ViewedCloud> feet;
  for (const auto& indices : separated.feet) feet.push_back(subset(points, indices));
  return feet;
}

/// Without a platform, seen or given: the lowest points of the feet.
void estimate_standing_height(const std::vector<ViewedCloud>& feet, FusedScene& scene) {
  std::vector<double> heights;
  for (const auto& foot : feet) {
    for (const auto& point : foot.cloud.positions) heights.push_back(point.z());
  }
  scene.standing_height_mm = quantile(std::move(heights), kLowestShare);
  scene.warnings.push_back(
      "no camera saw the platform; its height is taken from the lowest points of the feet, and "
      "heights over it may be too small: give it (platform_height_mm in the settings, "
      "platform.height_mm in a recording), or turn a camera to it");
}

std::vector<ViewErrors> errors_of(const std::vector<WorkingView>& views) {
  std::vector<ViewErrors> errors;
  for (const auto& view : views) errors.push_back({view.errors, view.station_from_camera});
  return errors;
}

std::vector<Eigen::Vector3d> cameras_of(const std::vector<WorkingView>& views) {
  std::vector<Eigen::Vector3d> cameras;
  for (const auto& view : views) cameras.push_back(view.station_from_camera.translation());
  return cameras;
}

void finish_foot(const ViewedCloud& points, const std::vector<WorkingView>& views,
                 const FusionSettings& settings, FusedScene& scene) {
  ThinSettings thinning;
  thinning.spacing_mm = settings.point_spacing_mm;
  thinning.view_sigma_mm = scene.diagnostics.unexplained_mm / std::numbers::sqrt2;  // of each view
  auto [foot, shares] = thin(points, views.size(), thinning);
  foot.shared_errors_mm = shared_errors_of(foot, shares, errors_of(views));
  foot.local_errors = local_errors_of(foot, shares, cameras_of(views), scene.diagnostics.bent);
  std::vector<std::string> warnings;
  if (coverage_of(foot) < kLeastCoverage) {
    warnings.emplace_back(
        "it was not seen from all sides: scan it alone, or turn a camera to its hidden side");
  }
  const SoleClosure closure = close_sole(foot, scene.standing_height_mm);
  if (closure.points_added > 0) {
    warnings.push_back(
        "no camera saw the sole; it is closed by the platform, which it is taken to meet up to " +
        in_millimetres(closure.widest_inset_mm) + " inside the seen skin");
  }
  scene.feet.push_back(std::move(foot));
  scene.foot_warnings.push_back(std::move(warnings));
}

/// What stands there and is no foot may be one that cameras see in wrong places.
Error no_foot(const PointCloud& points, const FusedScene& scene) {
  const auto failure = fail(ErrorCode::kInsufficientData, "no foot stands on the platform",
                            "step on the platform with bare feet or thin socks, then scan again");
  return points.empty() ? failure.value() : with_what_was_noticed(failure.value(), scene.warnings);
}

/// If it fails for a contradiction, says which.
Result<FusedScene> fuse(const std::vector<View>& views, const FusionSettings& settings,
                        const Work& work, std::optional<Contradiction>& contradiction) {
  const auto& [workers, go_on] = work;
  FusedScene scene;
  auto opened = open_views(in_order(views), work);
  if (!opened) return tl::make_unexpected(opened.error());
  auto& working = *opened;
  drop_blind_views(working, settings, scene);
  if (working.empty()) {
    return fail(ErrorCode::kInsufficientData, "no camera saw anything near the platform",
                "check that nothing covers the cameras and that they point at the platform");
  }
  const auto checked = check_poses(settings, workers, go_on, working, scene);
  if (!checked) return tl::make_unexpected(checked.error());
  scene.diagnostics.views_used = working.size();
  find_standing_plane(working, settings, scene);
  if (!go_on()) return cancelled();
  auto points = gather_feet(working, settings, work, scene, contradiction);
  if (!points) return tl::make_unexpected(points.error());
  drop_outliers(*points);
  if (!go_on()) return cancelled();
  const auto feet = pick_feet(*points, scene);
  if (!go_on()) return cancelled();
  if (feet.empty()) return tl::make_unexpected(no_foot(points->cloud, scene));
  scene.is_standing_height_known =
      scene.diagnostics.platform_found || settings.platform_height_mm.has_value();
  if (!scene.is_standing_height_known) estimate_standing_height(feet, scene);
  for (const auto& foot : feet) {
    finish_foot(foot, working, settings, scene);
    if (!go_on()) return cancelled();
  }
  return scene;
}

/// Where three or more views are there, the one that is contradicted most is left out.
Result<FusedScene> fuse_without(const Contradiction& odd, std::vector<View> views,
                                const FusionSettings& settings, const Work& work) {
  std::erase_if(views, [&](const View& view) { return view.geometry.id == odd.camera; });
  std::optional<Contradiction> still;
  auto scene = fuse(views, settings, work, still);
  if (still) return tl::make_unexpected(contradicted(odd));
  if (scene) {
    scene->warnings.push_back(
        "camera " + odd.camera +
        " does not agree with the others and was left out: they see through " +
        in_percent(odd.share) +
        " of what it saw of the feet; calibrate the station (instep calibrate)");
  }
  return scene;
}

}  // namespace

Result<FusedScene> fuse_views(const std::vector<View>& views, const FusionSettings& settings,
                              const Workers& workers, const GoOn& go_on) {
  if (views.empty()) {
    return fail(ErrorCode::kInvalidInput, "there is no view to fuse", "connect a camera");
  }
  const Work work{workers, go_on};
  std::optional<Contradiction> contradiction;
  auto scene = fuse(views, settings, work, contradiction);
  if (!contradiction || contradiction->views < 3) return scene;
  return fuse_without(*contradiction, views, settings, work);
}

}  // namespace instep
