#include "core/geometry/distinct_points.h"

#include <algorithm>
#include <tuple>

namespace instep {
namespace {

/// The index of the point that counts at each place, ascending; `replaces`: whether a point counts
/// before another at its place that comes before it in the list.
template <typename Replaces>
std::vector<std::size_t> one_at_each_place(const std::vector<Eigen::Vector3d>& points,
                                           const Replaces& replaces) {
  std::vector<std::tuple<double, double, double, std::size_t>> sorted;
  sorted.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    sorted.emplace_back(points[i].x(), points[i].y(), points[i].z(), i);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::size_t> counting;
  for (const auto& [x, y, z, index] : sorted) {
    if (counting.empty() || points[index] != points[counting.back()]) {
      counting.push_back(index);
    } else if (replaces(index, counting.back())) {
      counting.back() = index;
    }
  }
  std::sort(counting.begin(), counting.end());
  return counting;
}

auto coordinates(const Eigen::Vector3d& direction) {
  return std::tuple(direction.x(), direction.y(), direction.z());
}

}  // namespace

std::vector<std::size_t> distinct_points(const std::vector<Eigen::Vector3d>& points) {
  return one_at_each_place(points, [](std::size_t, std::size_t) { return false; });
}

std::vector<std::size_t> distinct_points(const PointCloud& cloud) {
  return one_at_each_place(cloud.positions, [&](std::size_t one, std::size_t other) {
    return counts_before(cloud, one, other);
  });
}

bool counts_before(const PointCloud& cloud, std::size_t one, std::size_t other) {
  if (cloud.was_seen(one) != cloud.was_seen(other)) return cloud.was_seen(one);
  if (cloud.has_sigma() && cloud.sigma_mm[one] != cloud.sigma_mm[other]) {
    return cloud.sigma_mm[one] > cloud.sigma_mm[other];
  }
  if (cloud.has_normals() && cloud.normals[one] != cloud.normals[other]) {
    return coordinates(cloud.normals[one]) < coordinates(cloud.normals[other]);
  }
  if (cloud.view_directions.empty()) return false;
  return coordinates(cloud.view_directions[one]) < coordinates(cloud.view_directions[other]);
}

}  // namespace instep
