#include "core/girth/plane_slab.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace instep {
namespace {

bool comes_before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::tuple(a.x(), a.y(), a.z()) < std::tuple(b.x(), b.y(), b.z());
}

}  // namespace

PlaneSlab slab_of(const PointCloud& cloud, const TapePlane& plane, double half_width) {
  std::vector<std::pair<Eigen::Vector3d, std::size_t>> found;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double height = plane.distance(cloud.positions[i]);
    if (std::abs(height) > half_width) continue;
    const Eigen::Vector2d place = plane.project(cloud.positions[i]);
    found.emplace_back(Eigen::Vector3d(place.x(), place.y(), height), i);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return comes_before(a.first, b.first); });
  found.erase(std::unique(found.begin(), found.end(),
                          [](const auto& a, const auto& b) { return a.first == b.first; }),
              found.end());
  PlaneSlab slab;
  for (const auto& [place, index] : found) {
    slab.indices.push_back(index);
    slab.places.push_back(place);
  }
  return slab;
}

}  // namespace instep
