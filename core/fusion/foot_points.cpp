#include "core/fusion/foot_points.h"

#include <cmath>
#include <cstdint>

#include "core/fusion/station_region.h"
#include "core/fusion/views/seen_through.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kFootCeilingMm = 150.0;  // points higher above the platform are leg and are cut
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
