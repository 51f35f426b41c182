#include "core/girth/plane_slab.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace instep {
namespace {

/// A place of the cloud with its distance from the plane, to be put in order by the place alone.
struct Found {
  Eigen::Vector3d place;
  std::size_t index;

  bool operator<(const Found& other) const {
    if (place.x() != other.place.x()) return place.x() < other.place.x();
    return std::tuple(place.y(), place.z(), index) <
           std::tuple(other.place.y(), other.place.z(), other.index);
  }
};

}  // namespace

PlaneSlab slab_of(const PointCloud& cloud, const TapePlane& plane, double half_width) {
  std::vector<Found> found;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double height = plane.distance(cloud.positions[i]);
    if (std::abs(height) > half_width) continue;
    const Eigen::Vector2d place = plane.project(cloud.positions[i]);
    found.push_back({{place.x(), place.y(), height}, i});
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end(),
                          [](const Found& a, const Found& b) { return a.place == b.place; }),
              found.end());
  PlaneSlab slab;
  slab.indices.reserve(found.size());
  slab.places.reserve(found.size());
  for (const auto& [place, index] : found) {
    slab.indices.push_back(index);
    slab.places.push_back(place);
  }
  return slab;
}

}  // namespace instep
