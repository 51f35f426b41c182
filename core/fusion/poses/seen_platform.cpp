#include "core/fusion/poses/seen_platform.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr int kStride = 3;             // every so many pixels, both ways
constexpr double kRadiusMm = 450.0;    // about the station's upright axis
constexpr double kMostTiltDeg = 30.0;  // by the given poses
constexpr double kBelowMm = 10.0;      // beyond any noise of a platform

/// No flat top of an object: what a camera sees beside it lies lower.
bool is_lowest(const FoundPlatform& platform, const std::vector<Vector3d>& points) {
  const double reach = 3.0 * platform.scatter_mm + 1.0;
  std::size_t on_it = 0;
  std::size_t below = 0;
  for (const auto& point : points) {
    const double distance = platform.distance(point);
    if (distance < -kBelowMm) ++below;
    if (std::abs(distance) <= reach) ++on_it;
  }
  return below < on_it;
}

}  // namespace

std::optional<FoundPlatform> seen_platform(const std::vector<const WorkingView*>& views,
                                           double height_mm) {
  std::vector<Vector3d> points;
  for (const auto* view : views) {
    visit_pixels(*view, kStride, [&](std::size_t, const Vector3d& point) {
      if (is_within(point, kRadiusMm)) points.push_back(point);
    });
  }
  PlatformSettings search;
  search.most_tilt_deg = kMostTiltDeg;
  search.expected_height_mm = height_mm;
  for (const double reach_mm : {40.0, 120.0}) {
    search.search_mm = reach_mm;
    if (auto near = find_platform(points, search)) return near;
  }
  search.expected_height_mm.reset();
  const auto anywhere = find_platform(points, search);
  return anywhere && is_lowest(*anywhere, points) ? anywhere : std::nullopt;
}

RigidTransform onto_platform(const FoundPlatform& platform, double height_mm) {
  RigidTransform level = platform.level_from_station();
  level.translation().z() += height_mm - platform.height_mm();
  return level;
}

double variance_of_level_normals(const std::vector<PosedCloud>& clouds, double height_mm,
                                 double reach_mm) {
  std::vector<double> leans;
  for (const auto& [cloud, pose] : clouds) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double height = std::abs(cloud.positions[i].z() - height_mm);
      if (height < reach_mm) {
        leans.push_back(cloud.normals[i].head<2>().squaredNorm());
      }
    }
  }
  // Half of them lean by less than 2 ln 2 of it, squared.
  return median(std::move(leans)) / (2.0 * std::numbers::ln2);
}

}  // namespace instep
