#include "core/geometry/distinct_points.h"

#include <algorithm>
#include <tuple>

namespace instep {
namespace {

auto coordinates(const Eigen::Vector3d& direction) {
  return std::tuple(direction.x(), direction.y(), direction.z());
}

}  // namespace

std::vector<std::size_t> first_at_same_place(const std::vector<Eigen::Vector3d>& points) {
  std::vector<std::tuple<double, double, double, std::size_t>> sorted;
  sorted.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    sorted.emplace_back(points[i].x(), points[i].y(), points[i].z(), i);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::size_t> firsts(points.size());
  std::size_t first = sorted.empty() ? 0 : std::get<3>(sorted.front());
  for (const auto& [x, y, z, index] : sorted) {
    if (points[index] != points[first]) first = index;
    firsts[index] = first;
  }
  return firsts;
}

std::vector<std::size_t> distinct_points(const std::vector<Eigen::Vector3d>& points) {
  const auto firsts = first_at_same_place(points);
  std::vector<std::size_t> distinct;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (firsts[i] == i) distinct.push_back(i);
  }
  return distinct;
}

std::vector<std::size_t> distinct_points(const PointCloud& cloud) {
  const auto firsts = first_at_same_place(cloud.positions);
  std::vector<std::size_t> counting(cloud.size());  // for the first at each place
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    std::size_t& counts = counting[firsts[i]];
    if (firsts[i] == i || counts_before(cloud, i, counts)) counts = i;
  }
  std::vector<std::size_t> distinct;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (firsts[i] == i) distinct.push_back(counting[i]);
  }
  std::sort(distinct.begin(), distinct.end());
  return distinct;
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
