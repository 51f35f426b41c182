#include "core/foot/low_walls.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/foot/full_size.h"
#include "core/fusion/wall_foot.h"
#include "core/geometry/moments.h"
#include "core/geometry/place_hash.h"
#include "core/geometry/point_index.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kHeightMm = kHighestWallEndMm + kWallBendReachMm;
constexpr double kMiddleMm = 20.0;  ///< height over the floor that lies within the foot
constexpr std::size_t kNeighbours = 14;

/// Of a wall round a foot, pointing away from the foot's middle line.
std::vector<Vector3d> outward_normals(const std::vector<Vector3d>& points) {
  const PointIndex index(points);
  std::vector<Vector3d> normals;
  normals.reserve(points.size());
  for (const auto& point : points) {
    const auto close = index.nearest(point, kNeighbours);
    Moments moments;
    for (const auto& one : close) moments.add(points[one.index] - point);
    Vector3d normal = moments.flattest();
    const Vector3d middle(std::clamp(point.x(), 0.12 * kFullSizeMm, 0.85 * kFullSizeMm), 0.0,
                          kMiddleMm);
    if (normal.dot(point - middle) < 0.0) normal = -normal;
    normals.push_back(normal);
  }
  return normals;
}

}  // namespace

LowWalls::LowWalls(const FootScan& foot, std::size_t most_points)
    : to_full_size(full_size_factor(foot.landmarks.at("acropodion").position_mm.x())) {
  std::vector<std::size_t> low;
  for (std::size_t i = 0; i < foot.cloud.size(); ++i) {
    if (to_full_size * foot.cloud.positions[i].z() < kHeightMm) low.push_back(i);
  }
  if (low.size() < kNeighbours) return;
  points = foot.cloud.subset(low);
  if (points.size() > most_points) {
    points = points.subset(some_by_place(points.positions, most_points));
  }
  points.drop_errors_along_normals();  // of points at another size
  for (auto& place : points.positions) place *= to_full_size;
  if (!points.has_normals()) points.normals = outward_normals(points.positions);
}

}  // namespace instep
