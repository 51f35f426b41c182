#include "core/fusion/fuse_views.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/fusion/seen_through.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr int kPoseStride = 2;          // every so many pixels, both ways, for refining poses
constexpr int kPlatformStride = 3;      // and for finding the platform
constexpr double kLowestShare = 0.002;  // of a scene's points below which they are taken for noise
constexpr int kSectors = 72;
constexpr double kLeastCoverage = 0.9;

/// One view on its way to points.
struct WorkingView {
  std::string id;
  std::shared_ptr<const Deprojector> rays;
  FusedDepth depth;
  RigidTransform station_from_camera;
  std::vector<Eigen::Vector3f> grid;  ///< camera frame, one a pixel

  Vector3d in_station(std::size_t pixel) const {
    return station_from_camera * grid[pixel].cast<double>();
  }
};

std::string in_millimetres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f mm", value);
  return text;
}

Result<WorkingView> open_view(const View& view, const FusionSettings& settings, FusedScene& scene) {
  const auto& [geometry, depth, rays] = view;
  if (!is_rigid(geometry.station_from_camera.matrix()) ||
      geometry.station_from_camera.translation().cwiseAbs().maxCoeff() > kLargestCoordinateMm) {
    return fail(ErrorCode::kInvalidInput, "the pose of camera " + geometry.id + " is not sound",
                "calibrate the station");
  }
  WorkingView working{geometry.id, rays, depth, geometry.station_from_camera, {}};
  if (!working.rays) {
    auto made = Deprojector::create(geometry.intrinsics);
    if (!made) {
      auto error = made.error();
      error.message = "camera " + geometry.id + ": " + error.message;
      return tl::make_unexpected(error);
    }
    working.rays = std::make_shared<const Deprojector>(std::move(*made));
  }
  const auto& lens = working.rays->intrinsics();
  const auto pixels = static_cast<std::size_t>(lens.width) * static_cast<std::size_t>(lens.height);
  if (depth.width != lens.width || depth.height != lens.height || depth.depth_mm.size() != pixels ||
      depth.sigma_mm.size() != pixels) {
    return fail(ErrorCode::kCorruptData,
                "the depth image of camera " + geometry.id + " does not have the camera's size",
                "check the camera's resolution in the configuration");
  }
  const auto holds_data = [](float depth_mm) { return depth_mm > 0.0F; };
  scene.diagnostics.pixels += static_cast<std::size_t>(
      std::count_if(depth.depth_mm.begin(), depth.depth_mm.end(), holds_data));
  scene.diagnostics.flying_pixels += drop_flying_pixels(lens, settings.surface, working.depth);
  working.rays->deproject(working.depth.depth_mm, working.grid);
  if (depth.moved) {
    scene.warnings.push_back("the foot moved by about " + in_millimetres(depth.movement_mm) +
                             " while camera " + geometry.id + " looked; stand still and repeat");
  }
  return working;
}

/// Pixels, `stride` apart both ways, whose points pass `wanted(point in the station, sigma)`.
template <typename Wanted>
std::vector<std::uint32_t> pixels_where(const WorkingView& view, int stride, const Wanted& wanted) {
  std::vector<std::uint32_t> pixels;
  for (int v = 0; v < view.depth.height; v += stride) {
    for (int u = 0; u < view.depth.width; u += stride) {
      const auto pixel = static_cast<std::size_t>(v * view.depth.width + u);
      if (!(view.depth.depth_mm[pixel] > 0.0F)) continue;
      if (wanted(view.in_station(pixel), view.depth.sigma_mm[pixel])) {
        pixels.push_back(static_cast<std::uint32_t>(pixel));
      }
    }
  }
  return pixels;
}

bool in_region(const Vector3d& point, const FusionSettings& settings) {
  const double height = point.z() - settings.platform_height_mm.value_or(0.0);
  return point.head<2>().norm() <= settings.region_radius_mm &&
         std::abs(height) <= settings.region_height_mm;
}

PointCloud station_cloud(const WorkingView& view, const std::vector<std::uint32_t>& pixels,
                         const FusionSettings& settings) {
  return transformed(view.station_from_camera,
                     surface_points(*view.rays, view.depth, pixels, settings.surface));
}

/// Drops the views in which nothing is left, with a warning each.
void drop_blind_views(std::vector<WorkingView>& views, const FusionSettings& settings,
                      FusedScene& scene) {
  std::erase_if(views, [&](const WorkingView& view) {
    const auto seen = pixels_where(view, kPlatformStride, [&](const Vector3d& point, double) {
      return in_region(point, settings);
    });
    if (!seen.empty()) return false;
    scene.warnings.push_back("camera " + view.id + " saw nothing near the platform");
    return true;
  });
}

/// Aligns the views to each other and drops those that do not fit.
void refine_poses(std::vector<WorkingView>& views, const FusionSettings& settings,
                  FusedScene& scene) {
  std::vector<PointCloud> clouds;
  for (const auto& view : views) {
    const auto pixels = pixels_where(view, kPoseStride, [&](const Vector3d& point, double) {
      return in_region(point, settings);
    });
    clouds.push_back(station_cloud(view, pixels, settings));
  }
  const auto registration = register_views(clouds, settings.registration);
  scene.diagnostics.registration_before_mm = registration.residual_before_mm;
  scene.diagnostics.registration_after_mm = registration.residual_after_mm;
  std::vector<WorkingView> fitting;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto& registered = registration.views[i];
    if (registered.fit == ViewFit::kDoesNotFit) {
      scene.warnings.push_back("camera " + views[i].id +
                               " does not agree with the others and was left out");
      continue;
    }
    if (registered.fit == ViewFit::kAlone) {
      scene.warnings.push_back("camera " + views[i].id +
                               " shares no surface with the others; its pose is not checked");
    }
    views[i].station_from_camera = registered.correction * views[i].station_from_camera;
    fitting.push_back(std::move(views[i]));
  }
  views = std::move(fitting);
}

/// Finds the platform and turns the station until it is level. Without one the lowest points stand
/// for it.
void find_standing_plane(std::vector<WorkingView>& views, const FusionSettings& settings,
                         FusedScene& scene) {
  std::vector<Vector3d> points;
  for (const auto& view : views) {
    (void)pixels_where(view, kPlatformStride, [&](const Vector3d& point, double) {
      if (in_region(point, settings)) points.push_back(point);
      return false;
    });
  }
  auto search = settings.platform;
  search.expected_height_mm = settings.platform_height_mm;
  if (const auto platform = find_platform(points, search)) {
    scene.diagnostics.platform_found = true;
    scene.diagnostics.platform_scatter_mm = platform->scatter_mm;
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

/// The points above the platform and below the ceiling, of all views.
ViewedCloud gather_feet(const std::vector<WorkingView>& views, const FusionSettings& settings,
                        FusedScene& scene) {
  ViewedCloud gathered;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto pixels = pixels_where(views[i], 1, [&](const Vector3d& point, double sigma_mm) {
      const double height = point.z() - scene.standing_height_mm;
      if (!in_region(point, settings) || height > settings.foot_ceiling_mm) return false;
      if (!scene.diagnostics.platform_found) return true;
      // Depth errs along the line of sight; only its upright part lifts a platform point.
      const Vector3d sight = (point - views[i].station_from_camera.translation()).normalized();
      const double upright = 4.0 * sigma_mm * std::abs(sight.z());
      const bool above = height > std::max(settings.platform_clearance_mm, upright);
      if (!above) ++scene.diagnostics.platform_pixels;
      return above;
    });
    const PointCloud cloud = station_cloud(views[i], pixels, settings);
    scene.diagnostics.grazing_pixels += pixels.size() - cloud.size();
    gathered.cloud.append(cloud);
    gathered.views.resize(gathered.cloud.size(), static_cast<std::uint16_t>(i));
  }
  return gathered;
}

ViewedCloud subset(const ViewedCloud& points, const std::vector<std::size_t>& indices) {
  ViewedCloud part;
  part.cloud = points.cloud.subset(indices);
  for (const std::size_t index : indices) part.views.push_back(points.views[index]);
  return part;
}

void drop_outliers(const std::vector<WorkingView>& views, const FusionSettings& settings,
                   ViewedCloud& points, FusedScene& scene) {
  std::vector<PosedDepth> posed;
  for (const auto& view : views) {
    posed.push_back({&view.rays->intrinsics(), &view.depth, view.station_from_camera});
  }
  const double margin = settings.seen_through_mm + 2.0 * scene.diagnostics.registration_after_mm;
  const std::size_t before = points.cloud.size();
  points = subset(points, points_not_seen_through(points, posed, margin));
  points = subset(points, crowded_points(points.cloud, settings.outliers));
  points = subset(points, clustered_points(points.cloud, settings.outliers));
  scene.diagnostics.outliers = before - points.cloud.size();
}

/// Share of the directions round the middle of a foot in which its wall was seen.
double coverage_of(const PointCloud& foot) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const auto& point : foot.positions) middle += point.head<2>();
  middle /= static_cast<double>(foot.size());
  std::vector<bool> seen(kSectors, false);
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const Eigen::Vector2d outward = foot.positions[i].head<2>() - middle;
    if (std::abs(foot.normals[i].z()) > 0.8 || outward.dot(foot.normals[i].head<2>()) < 0.0)
      continue;
    const double turn = std::atan2(outward.y(), outward.x()) / (2.0 * std::numbers::pi) + 0.5;
    seen[std::min<std::size_t>(kSectors - 1, static_cast<std::size_t>(turn * kSectors))] = true;
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) / kSectors;
}

std::vector<ViewedCloud> pick_feet(const ViewedCloud& points, const FusionSettings& settings,
                                   FusedScene& scene) {
  const auto separated =
      separate_feet(points.cloud.positions, scene.standing_height_mm, settings.separation);
  scene.diagnostics.strays = separated.strays;
  scene.warnings.insert(scene.warnings.end(), separated.warnings.begin(), separated.warnings.end());
  std::vector<ViewedCloud> feet;
  for (const auto& indices : separated.feet) feet.push_back(subset(points, indices));
  return feet;
}

/// Without a platform: the lowest points of the feet.
void estimate_standing_height(const std::vector<ViewedCloud>& feet, FusedScene& scene) {
  std::vector<double> heights;
  for (const auto& foot : feet) {
    for (const auto& point : foot.cloud.positions) heights.push_back(point.z());
  }
  const auto rank = heights.begin() +
                    static_cast<std::ptrdiff_t>(kLowestShare * static_cast<double>(heights.size()));
  std::nth_element(heights.begin(), rank, heights.end());
  scene.standing_height_mm = *rank;
  scene.warnings.push_back(
      "no camera saw the platform; its height is taken from the lowest points of the feet");
}

void finish_foot(const ViewedCloud& points, const FusionSettings& settings, FusedScene& scene) {
  ThinSettings thinning;
  thinning.spacing_mm = settings.point_spacing_mm;
  thinning.pose_sigma_mm = scene.diagnostics.registration_after_mm;
  PointCloud foot = thin(points, thinning);
  const std::string name = "foot " + std::to_string(scene.feet.size() + 1);
  const double coverage = coverage_of(foot);
  scene.diagnostics.points.push_back(foot.size());
  scene.diagnostics.coverage.push_back(coverage);
  if (coverage < kLeastCoverage) {
    scene.warnings.push_back(name + " was not seen from all sides");
  }
  std::size_t added = 0;
  if (settings.close_soles) {
    added = close_sole(foot, scene.standing_height_mm, settings.sole).points_added;
  }
  if (added > 0) {
    scene.warnings.push_back("no camera saw the sole of " + name +
                             "; it is closed by the platform");
  }
  scene.diagnostics.platform_points.push_back(added);
  scene.feet.push_back(std::move(foot));
}

}  // namespace

Result<FusedScene> fuse_views(const std::vector<View>& views, const FusionSettings& settings) {
  if (views.empty()) {
    return fail(ErrorCode::kInvalidInput, "there is no view to fuse", "connect a camera");
  }
  FusedScene scene;
  std::vector<WorkingView> working;
  for (const auto& view : views) {
    auto opened = open_view(view, settings, scene);
    if (!opened) return tl::make_unexpected(opened.error());
    working.push_back(std::move(*opened));
  }
  drop_blind_views(working, settings, scene);
  if (working.empty()) {
    return fail(ErrorCode::kInsufficientData, "no camera saw anything near the platform",
                "check that nothing covers the cameras and that they point at the platform");
  }
  if (settings.refine_views) refine_poses(working, settings, scene);
  scene.diagnostics.views_used = working.size();
  find_standing_plane(working, settings, scene);
  ViewedCloud points = gather_feet(working, settings, scene);
  drop_outliers(working, settings, points, scene);
  const auto feet = pick_feet(points, settings, scene);
  if (feet.empty()) {
    return fail(ErrorCode::kInsufficientData, "no foot stands on the platform",
                "step on the platform with bare feet or thin socks, then scan again");
  }
  if (!scene.diagnostics.platform_found) estimate_standing_height(feet, scene);
  for (const auto& foot : feet) finish_foot(foot, settings, scene);
  return scene;
}

}  // namespace instep
