#include "core/girth/plane_slab.h"

#include <cmath>

#include "core/geometry/distinct_points.h"

namespace instep {

PlaneSlab slab_of(const PointCloud& cloud, const TapePlane& plane, double half_width) {
  std::vector<std::size_t> near;
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (std::abs(plane.distance(cloud.positions[i])) > half_width) continue;
    near.push_back(i);
    positions.push_back(cloud.positions[i]);
  }
  PlaneSlab slab;
  for (const std::size_t k : distinct_points(positions)) {
    const Eigen::Vector2d place = plane.project(positions[k]);
    slab.indices.push_back(near[k]);
    slab.places.emplace_back(place.x(), place.y(), plane.distance(positions[k]));
  }
  return slab;
}

}  // namespace instep
