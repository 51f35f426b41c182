#include "core/foot/sole/low_walls.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/foot/full_size.h"
#include "core/fusion/sole/wall_foot.h"
#include "core/geometry/moments_round.h"
#include "core/geometry/place_hash.h"
#include "core/geometry/point_index.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kHeightMm = kHighestWallEndMm + kWallBendReachMm;
constexpr double kMiddleMm = 20.0;  ///< height over the floor that lies within the foot
constexpr std::size_t kNeighbours = 14;
constexpr std::size_t kMostNeighbours = 224;  ///< where these are all of one line

/// How the skin spreads round a point; nothing of a scanner's line that runs alone, by which
/// nothing tells how it leans.
std::optional<SpreadAxes> spread_of_skin(const Vector3d& point, const PointIndex& index) {
  constexpr double kLine = 0.05;  // squared: the breadth of what runs on in lines, over its length
  constexpr double kFarthestMm = 15.0;
  for (std::size_t count = kNeighbours; count <= kMostNeighbours; count *= 4) {
    const auto near = index.nearest(point, count);
    const SpreadAxes axes = moments_round(index, point, near).axes();
    if (!are_on_a_line(axes, kLine)) return axes;
    if (near.size() < count || std::sqrt(near.back().squared_distance) > kFarthestMm) break;
  }
  return std::nullopt;
}

/// Gives points of walls round a foot their normals, away from the foot's middle line, and drops
/// those with none.
void keep_those_of_skin(PointCloud& walls) {
  const PointIndex index(walls.positions);
  std::vector<std::size_t> kept;
  std::vector<Vector3d> normals;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Vector3d& point = walls.positions[i];
    const auto axes = spread_of_skin(point, index);
    if (!axes) continue;
    const Vector3d middle(std::clamp(point.x(), 0.12 * kFullSizeMm, 0.85 * kFullSizeMm), 0.0,
                          kMiddleMm);
    const Vector3d normal = axes->eigenvectors().col(0);
    kept.push_back(i);
    normals.push_back(normal.dot(point - middle) < 0.0 ? Vector3d(-normal) : normal);
  }
  walls = walls.subset(kept);
  walls.normals = std::move(normals);
}

}  // namespace

LowWalls::LowWalls(const FootScan& foot, std::size_t most_points)
    : to_full_size(full_size_factor(foot.length_mm())) {
  std::vector<std::size_t> low;
  for (std::size_t i = 0; i < foot.shape().size(); ++i) {
    if (to_full_size * foot.shape().positions[i].z() < kHeightMm) low.push_back(i);
  }
  if (low.size() < kNeighbours) return;
  points = foot.shape().subset(low);
  if (points.size() > most_points) {
    points = points.subset(some_by_place(points.positions, most_points));
  }
  points.drop_errors_along_normals();  // of points at another size
  for (auto& place : points.positions) place *= to_full_size;
  if (!points.has_normals()) keep_those_of_skin(points);
}

}  // namespace instep
