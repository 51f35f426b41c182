#include "core/foot/end_facing.h"

#include <cmath>
#include <utility>

#include "core/geometry/moments.h"
#include "core/geometry/point_index.h"
#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kDepthMm = 2.5;
constexpr double kBesideMm = 15.0;
constexpr double kNeighbourhoodMm = 5.0;
constexpr std::size_t kFewestNeighbours = 8;

std::vector<PointIndex::Neighbour> neighbours_of(const Vector3d& point, const PointIndex& index) {
  auto near = index.around(point, kNeighbourhoodMm);
  return near.size() < kFewestNeighbours ? index.nearest(point, kFewestNeighbours) : near;
}

Vector3d normal_at(const Vector3d& point, const PointIndex& index) {
  Moments moments;
  for (const auto& neighbour : neighbours_of(point, index)) {
    moments.add(index.points()[neighbour.index] - point);
  }
  return moments.flattest();
}

}  // namespace

double end_facing(const std::vector<Vector3d>& points, const Vector3d& end,
                  const Vector3d& direction) {
  std::vector<Vector3d> near;
  std::vector<Vector3d> last;
  for (const auto& point : points) {
    const Vector3d offset = point - end;
    const double depth = -direction.dot(offset);
    const double beside = (offset + depth * direction).norm();
    if (depth > kDepthMm + kNeighbourhoodMm || beside > kBesideMm + kNeighbourhoodMm) continue;
    near.push_back(point);
    if (depth <= kDepthMm && beside <= kBesideMm) last.push_back(point);
  }
  if (last.empty()) return 0.0;
  const PointIndex index(std::move(near));
  std::vector<double> facings;
  facings.reserve(last.size());
  for (const auto& point : last) {
    facings.push_back(std::abs(normal_at(point, index).dot(direction)));
  }
  return median(std::move(facings));
}

}  // namespace instep
