#include "core/foot/skin/end_facing.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "core/geometry/moments_round.h"
#include "core/geometry/point_index.h"
#include "core/geometry/voxel_grid.h"
#include "core/mean.h"
#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kDepthMm = 2.5;
constexpr double kBesideMm = 15.0;
constexpr double kNeighbourhoodMm = 5.0;
constexpr std::size_t kFewestNeighbours = 8;
constexpr double kCellMm = 1.0;

std::vector<PointIndex::Neighbour> neighbours_of(const Vector3d& point, const PointIndex& index) {
  auto near = index.around(point, kNeighbourhoodMm);
  return near.size() < kFewestNeighbours ? index.nearest(point, kFewestNeighbours) : near;
}

Vector3d normal_at(const Vector3d& point, const PointIndex& index) {
  return moments_round(index, point, neighbours_of(point, index)).flattest();
}

/// The means over cells of a millimetre.
std::vector<Vector3d> thinned(const std::vector<Vector3d>& points) {
  const VoxelGrid grid(points, kCellMm);
  std::vector<Vector3d> means;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    means.push_back(
        mean_of(grid.members(cell), [&](std::uint32_t member) { return points[member]; }));
  }
  return means;
}

/// Of points seen from the end.
struct Offset {
  double depth;
  double beside;

  Offset(const Vector3d& from_end, const Vector3d& direction)
      : depth(-direction.dot(from_end)), beside((from_end + depth * direction).norm()) {}

  bool is_within(double most_depth, double most_beside) const {
    return depth <= most_depth && beside <= most_beside;
  }
};

}  // namespace

std::optional<double> end_facing(const std::vector<Vector3d>& points, const Vector3d& end,
                                 const Vector3d& direction) {
  std::vector<Vector3d> near;
  for (const auto& point : points) {
    const Offset offset(point - end, direction);
    if (offset.is_within(kDepthMm + kNeighbourhoodMm, kBesideMm + kNeighbourhoodMm)) {
      near.push_back(point);
    }
  }
  const PointIndex index(thinned(near));
  std::vector<double> facings;
  for (const auto& point : index.points()) {
    if (!Offset(point - end, direction).is_within(kDepthMm, kBesideMm)) continue;
    facings.push_back(std::abs(normal_at(point, index).dot(direction)));
  }
  if (facings.empty()) return std::nullopt;
  return median(std::move(facings));
}

}  // namespace instep
