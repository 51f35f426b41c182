#include "core/surface/surface_normals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace instep {
namespace {

constexpr std::size_t kTreeNeighbours = 10;

/// A bend between two neighbours; the flattest comes first.
struct Bend {
  double size;
  std::size_t from;
  std::size_t to;

  bool operator<(const Bend& other) const {
    return std::pair(size, to) > std::pair(other.size, other.to);
  }
};

/// Turns the part of the cloud that hangs together with `root`; returns its points.
std::vector<std::size_t> orient_part(const std::vector<Eigen::Vector3d>& points,
                                     const PointIndex& index, std::size_t root,
                                     std::vector<bool>& reached,
                                     std::vector<Eigen::Vector3d>& normals) {
  std::vector<std::size_t> part;
  std::priority_queue<Bend> bends;
  bends.push({0.0, root, root});
  while (!bends.empty()) {
    const Bend bend = bends.top();
    bends.pop();
    if (reached[bend.to]) continue;
    reached[bend.to] = true;
    part.push_back(bend.to);
    if (normals[bend.from].dot(normals[bend.to]) < 0.0) normals[bend.to] *= -1.0;
    for (const auto& next : index.nearest(points[bend.to], kTreeNeighbours)) {
      if (reached[next.index]) continue;
      const double turn = 1.0 - std::abs(normals[bend.to].dot(normals[next.index]));
      bends.push({turn, bend.to, next.index});
    }
  }
  return part;
}

void turn_outwards(const std::vector<Eigen::Vector3d>& points, const std::vector<std::size_t>& part,
                   std::vector<Eigen::Vector3d>& normals) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const std::size_t i : part) middle += points[i].head<2>();
  middle /= static_cast<double>(part.size());
  double outward = 0.0;
  for (const std::size_t i : part)
    outward += normals[i].head<2>().dot(points[i].head<2>() - middle);
  if (outward >= 0.0) return;
  for (const std::size_t i : part) normals[i] *= -1.0;
}

}  // namespace

std::vector<Eigen::Vector3d> estimate_normals(const std::vector<Eigen::Vector3d>& points,
                                              const PointIndex& index, std::size_t count) {
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(points.size());
  for (const auto& point : points) {
    const auto nearest = index.nearest(point, count);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& neighbour : nearest) mean += points[neighbour.index];
    mean /= static_cast<double>(nearest.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const auto& neighbour : nearest) {
      const Eigen::Vector3d offset = points[neighbour.index] - mean;
      spread += offset * offset.transpose();
    }
    normals.push_back(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0));
  }
  return normals;
}

void orient_by_neighbours(const std::vector<Eigen::Vector3d>& points, const PointIndex& index,
                          std::vector<Eigen::Vector3d>& normals) {
  std::vector<bool> reached(points.size(), false);
  for (std::size_t root = 0; root < points.size(); ++root) {
    if (reached[root]) continue;
    turn_outwards(points, orient_part(points, index, root, reached, normals), normals);
  }
}

}  // namespace instep
