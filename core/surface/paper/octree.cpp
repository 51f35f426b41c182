#include "core/surface/paper/octree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace instep {
namespace {

/// Beyond this a cube of doubles has no middle of its own.
constexpr int kDeepest = 52;
constexpr std::size_t kChildren = 8;

std::size_t child_of(const Eigen::Vector3d& middle, const Eigen::Vector3d& place) {
  return (place.x() >= middle.x() ? 1U : 0U) + (place.y() >= middle.y() ? 2U : 0U) +
         (place.z() >= middle.z() ? 4U : 0U);
}

/// Faces between cubes are taken from one number, so that neighbours meet exactly.
Eigen::AlignedBox3d child_box(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& middle,
                              std::size_t child) {
  Eigen::AlignedBox3d part = box;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const bool upper = ((child >> axis) & 1U) != 0;
    (upper ? part.min() : part.max())[axis] = middle[axis];
  }
  return part;
}

Eigen::AlignedBox3d smallest_cube(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  const double half = 0.5 * box.sizes().maxCoeff();
  const Eigen::Vector3d middle = box.center();
  Eigen::AlignedBox3d cube(middle.array() - half, middle.array() + half);
  cube.extend(box);  // what rounding left out
  return cube;
}

}  // namespace

Octree::Octree(const std::vector<Eigen::Vector3d>& points, std::size_t most)
    : root_(smallest_cube(points)), nodes_(1) {
  std::vector<std::uint32_t> members(points.size());
  std::iota(members.begin(), members.end(), std::uint32_t{0});
  divide(0, root_, points, std::move(members), most, 0);
}

void Octree::divide(std::uint32_t node, const Eigen::AlignedBox3d& box,
                    const std::vector<Eigen::Vector3d>& points, std::vector<std::uint32_t> members,
                    std::size_t most, int depth) {
  if (members.empty()) return;
  if (members.size() <= most || depth == kDeepest) {
    nodes_[node].leaf = static_cast<std::uint32_t>(leaves_.size());
    leaves_.push_back({box, std::move(members)});
    return;
  }
  const Eigen::Vector3d middle = box.center();
  std::array<std::vector<std::uint32_t>, kChildren> parts;
  for (const std::uint32_t member : members) {
    parts[child_of(middle, points[member])].push_back(member);
  }
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].middle = middle;
  nodes_[node].first_child = first;
  nodes_.resize(nodes_.size() + kChildren);
  for (std::size_t child = 0; child < kChildren; ++child) {
    divide(first + static_cast<std::uint32_t>(child), child_box(box, middle, child), points,
           std::move(parts[child]), most, depth + 1);
  }
}

std::optional<std::size_t> Octree::leaf_at(const Eigen::Vector3d& place) const {
  if (!root_.contains(place)) return std::nullopt;
  std::uint32_t node = 0;
  while (nodes_[node].first_child != kNone) {
    node =
        nodes_[node].first_child + static_cast<std::uint32_t>(child_of(nodes_[node].middle, place));
  }
  if (nodes_[node].leaf == kNone) return std::nullopt;
  return nodes_[node].leaf;
}

std::optional<std::size_t> Octree::nearest_leaf(const Eigen::Vector3d& place, double reach) const {
  std::optional<std::size_t> nearest;
  double squared_distance = std::nextafter(reach * reach, std::numeric_limits<double>::max());
  search(0, root_, place, squared_distance, nearest);
  return nearest;
}

void Octree::search(std::uint32_t node, const Eigen::AlignedBox3d& box,
                    const Eigen::Vector3d& place, double& squared_distance,
                    std::optional<std::size_t>& nearest) const {
  const double distance = box.squaredExteriorDistance(place);
  if (distance >= squared_distance) return;
  if (nodes_[node].leaf != kNone) {
    nearest = nodes_[node].leaf;
    squared_distance = distance;
  }
  if (nodes_[node].first_child == kNone) return;
  const Eigen::Vector3d& middle = nodes_[node].middle;
  for (std::size_t child = 0; child < kChildren; ++child) {
    search(nodes_[node].first_child + static_cast<std::uint32_t>(child),
           child_box(box, middle, child), place, squared_distance, nearest);
  }
}

std::vector<std::size_t> Octree::touching(std::size_t leaf) const {
  std::vector<std::size_t> found;
  for (std::size_t other = 0; other < leaves_.size(); ++other) {
    if (other != leaf && leaves_[other].box.intersects(leaves_[leaf].box)) found.push_back(other);
  }
  return found;
}

std::vector<std::vector<std::uint32_t>> combined_points(
    const Octree& octree, std::size_t most,
    const std::function<bool(const std::vector<std::uint32_t>&)>& suffices) {
  const auto& leaves = octree.leaves();
  std::vector<std::vector<std::uint32_t>> combined;
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
    std::vector<std::uint32_t> points = leaves[leaf].points;
    std::set<std::size_t> joined;
    std::set<std::size_t> neighbours;
    std::size_t latest = leaf;
    while (points.size() <= most && !suffices(points)) {
      joined.insert(latest);
      for (const std::size_t other : octree.touching(latest)) neighbours.insert(other);
      for (const std::size_t inner : joined) neighbours.erase(inner);
      if (neighbours.empty()) break;
      latest = *std::min_element(neighbours.begin(), neighbours.end(), [&](auto a, auto b) {
        return leaves[a].points.size() < leaves[b].points.size();
      });
      points.insert(points.end(), leaves[latest].points.begin(), leaves[latest].points.end());
    }
    combined.push_back(std::move(points));
  }
  return combined;
}

}  // namespace instep
