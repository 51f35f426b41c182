#include "core/surface/paper/box_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>

#include "core/geometry/inverse_power.h"
#include "core/geometry/principal_frame.h"
#include "core/geometry/voxel_grid.h"

namespace instep {
namespace {

Eigen::AlignedBox3d bounding_box(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  return box;
}

/// Boxes are counted from the corner of the cloud.
VoxelGrid boxes_of(const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d corner = bounding_box(points).min();
  std::vector<Eigen::Vector3d> shifted;
  shifted.reserve(points.size());
  for (const auto& point : points) shifted.emplace_back(point - corner);
  const double size = neighbourhood_box_size(points);
  return VoxelGrid(shifted, size > 0.0 ? size : 1.0);
}

std::vector<Eigen::Vector3d> normals_of_boxes(const std::vector<Eigen::Vector3d>& points,
                                              const VoxelGrid& boxes) {
  std::vector<Eigen::Vector3d> normals;
  std::vector<Eigen::Vector3d> neighbours;
  for (std::size_t box = 0; box < boxes.cell_count(); ++box) {
    neighbours.clear();
    for (const std::size_t near : boxes.face_neighbourhood(box)) {
      for (const std::uint32_t member : boxes.members(near)) neighbours.push_back(points[member]);
    }
    normals.push_back(smallest_axis(spread_of(neighbours).covariance));
  }
  return normals;
}

/// Boxes, the one with the highest point first.
std::vector<std::size_t> highest_first(const std::vector<Eigen::Vector3d>& points,
                                       const VoxelGrid& boxes) {
  std::vector<std::pair<double, std::size_t>> tops;
  for (std::size_t box = 0; box < boxes.cell_count(); ++box) {
    double top = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t member : boxes.members(box)) top = std::max(top, points[member].z());
    tops.emplace_back(-top, box);
  }
  std::sort(tops.begin(), tops.end());
  std::vector<std::size_t> order;
  for (const auto& [height, box] : tops) order.push_back(box);
  return order;
}

const Eigen::Vector3d& highest_member(const std::vector<Eigen::Vector3d>& points,
                                      const VoxelGrid& boxes, std::size_t box) {
  const auto members = boxes.members(box);
  return points[*std::max_element(members.begin(), members.end(),
                                  [&](auto a, auto b) { return points[a].z() < points[b].z(); })];
}

void orient_breadth_first(const std::vector<Eigen::Vector3d>& points, const VoxelGrid& boxes,
                          std::vector<Eigen::Vector3d>& normals) {
  const Eigen::Vector3d mean = spread_of(points).mean;
  std::vector<bool> visited(boxes.cell_count(), false);
  for (const std::size_t root : highest_first(points, boxes)) {
    if (visited[root]) continue;
    visited[root] = true;
    if (normals[root].dot(highest_member(points, boxes, root) - mean) < 0.0) normals[root] *= -1.0;
    std::queue<std::size_t> open({root});
    while (!open.empty()) {
      const std::size_t box = open.front();
      open.pop();
      for (const std::size_t next : boxes.face_neighbourhood(box)) {
        if (visited[next]) continue;
        visited[next] = true;
        if (normals[box].dot(normals[next]) < 0.0) normals[next] *= -1.0;
        open.push(next);
      }
    }
  }
}

}  // namespace

double neighbourhood_box_size(const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d extents = bounding_box(points).sizes();
  const auto count = static_cast<double>(points.size());
  const double least = extents.maxCoeff() / std::sqrt(count);
  return std::cbrt(extents.cwiseMax(least).prod() / count);
}

std::vector<Eigen::Vector3d> box_normals(const std::vector<Eigen::Vector3d>& points) {
  const VoxelGrid boxes = boxes_of(points);
  auto of_boxes = normals_of_boxes(points, boxes);
  orient_breadth_first(points, boxes, of_boxes);
  std::vector<Eigen::Vector3d> normals(points.size());
  for (std::size_t box = 0; box < boxes.cell_count(); ++box) {
    for (const std::uint32_t member : boxes.members(box)) normals[member] = of_boxes[box];
  }
  return normals;
}

}  // namespace instep
