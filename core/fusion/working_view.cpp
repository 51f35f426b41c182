#include "core/fusion/working_view.h"

#include <cmath>

#include "core/fusion/frames/camera_limits.h"
#include "core/fusion/surface_points.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kFootCeilingMm = 150.0;  // points higher above the platform are leg and are cut
/// Points further from the station's origin, in plan and in height, are background.
constexpr double kRegionRadiusMm = 600.0;
constexpr double kRegionHeightMm = 500.0;
/// A point so far in front of what another camera sees there floats in the air.
constexpr double kSeenThroughMm = 4.0;
constexpr double kPlatformClearanceMm = 1.0;  // points nearer than this, or 4 sigma, are platform

/// Depth errs along the line of sight; only its upright part lifts a point off the platform.
bool stands_above_platform(const WorkingView& view, std::size_t pixel, const Vector3d& point,
                           double height) {
  if (height <= kPlatformClearanceMm) return false;
  const Vector3d sight = (point - view.station_from_camera.translation()).normalized();
  return height > 4.0 * double{view.depth.sigma_mm[pixel]} * std::abs(sight.z());
}

}  // namespace

Result<WorkingView> open_view(const View& view) {
  const auto& [geometry, depth, rays] = view;
  if (fault_of_pose(geometry.station_from_camera.matrix())) {
    return fail(ErrorCode::kInvalidInput, "the pose of camera " + geometry.id + " is not sound",
                "correct it, or have it found: instep calibrate");
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
  drop_flying_pixels(lens, working.depth);
  return working;
}

bool is_within(const Vector3d& point, double radius_mm) {
  return point.head<2>().squaredNorm() <= radius_mm * radius_mm;
}

bool in_region(const Vector3d& point, const FusionSettings& settings) {
  const double height = point.z() - settings.platform_height_mm.value_or(0.0);
  return is_within(point, kRegionRadiusMm) && std::abs(height) <= kRegionHeightMm;
}

PointCloud station_cloud(const WorkingView& view, const std::vector<std::uint32_t>& pixels) {
  return transformed(view.station_from_camera, surface_points(*view.rays, view.depth, pixels));
}

FootPoints foot_points(const std::vector<WorkingView>& views, std::size_t number,
                       const FusionSettings& settings, const FusedScene& scene) {
  const WorkingView& view = views[number];
  FootPoints found;
  std::vector<std::uint32_t> pixels;
  visit_pixels(view, 1, [&](std::size_t pixel, const Vector3d& point) {
    const double height = point.z() - scene.standing_height_mm;
    if (height > kFootCeilingMm || !in_region(point, settings)) return;
    if (scene.diagnostics.platform_found && !stands_above_platform(view, pixel, point, height)) {
      return;
    }
    pixels.push_back(static_cast<std::uint32_t>(pixel));
  });
  ViewedCloud seen;
  seen.cloud = station_cloud(view, pixels);
  seen.views.assign(seen.cloud.size(), static_cast<std::uint16_t>(number));

  std::vector<PosedDepth> posed;
  for (const auto& other : views) posed.push_back(other.posed());
  const double margin = kSeenThroughMm + 2.0 * scene.diagnostics.registration_after_mm;
  found.points = subset(seen, points_not_seen_through(seen, posed, margin));
  found.seen_through = seen.cloud.size() - found.points.cloud.size();
  return found;
}

}  // namespace instep
