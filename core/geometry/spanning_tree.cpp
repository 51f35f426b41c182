#include "core/geometry/spanning_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/geometry/disjoint_sets.h"
#include "core/geometry/point_index.h"

namespace instep {
namespace {

/// Neighbours of a point, itself included, that the first graph holds.
constexpr std::size_t kNeighbours = 13;

bool shorter(const TreeEdge& a, const TreeEdge& b) {
  return std::tie(a.length, a.from, a.to) < std::tie(b.length, b.from, b.to);
}

TreeEdge edge_between(std::size_t a, std::size_t b, double squared_length) {
  return {static_cast<std::uint32_t>(std::min(a, b)), static_cast<std::uint32_t>(std::max(a, b)),
          std::sqrt(squared_length)};
}

void take_shortest(std::vector<TreeEdge>& candidates, DisjointSets& parts,
                   std::vector<TreeEdge>& tree) {
  std::sort(candidates.begin(), candidates.end(), shorter);
  for (const TreeEdge& edge : candidates) {
    if (parts.join(edge.from, edge.to)) tree.push_back(edge);
  }
}

std::vector<TreeEdge> neighbour_edges(const std::vector<Eigen::Vector3d>& points) {
  const PointIndex index(points);
  std::vector<TreeEdge> edges;
  edges.reserve(points.size() * kNeighbours);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const auto& neighbour : index.nearest(points[i], kNeighbours)) {
      if (neighbour.index != i) {
        edges.push_back(edge_between(i, neighbour.index, neighbour.squared_distance));
      }
    }
  }
  return edges;
}

/// The points whose part has a 0, or a 1, at one place of its binary number.
struct Half {
  std::vector<std::uint32_t> members;
  std::vector<Eigen::Vector3d> places;
};

/// For each part its shortest edge to any other. The binary numbers of two parts differ somewhere:
/// so the nearest foreign point is the nearest of those found among the opposite halves.
std::vector<TreeEdge> shortest_edges_out(const std::vector<Eigen::Vector3d>& points,
                                         DisjointSets& parts) {
  const auto numbers = parts.numbers();
  std::vector<TreeEdge> best(parts.count(), {0, 0, std::numeric_limits<double>::infinity()});
  for (std::uint32_t bit = 0; (std::size_t{1} << bit) < parts.count(); ++bit) {
    Half halves[2];
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      Half& half = halves[(numbers[i] >> bit) & 1U];
      half.members.push_back(i);
      half.places.push_back(points[i]);
    }
    const PointIndex indices[2] = {PointIndex(halves[0].places), PointIndex(halves[1].places)};
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const std::size_t other = 1U - ((numbers[i] >> bit) & 1U);
      for (const auto& found : indices[other].nearest(points[i], 1)) {
        const auto edge =
            edge_between(i, halves[other].members[found.index], found.squared_distance);
        if (shorter(edge, best[numbers[i]])) best[numbers[i]] = edge;
      }
    }
  }
  return best;
}

}  // namespace

std::vector<TreeEdge> minimum_spanning_tree(const std::vector<Eigen::Vector3d>& points) {
  std::vector<TreeEdge> tree;
  if (points.size() < 2) return tree;
  tree.reserve(points.size() - 1);
  DisjointSets parts(points.size());
  auto candidates = neighbour_edges(points);
  take_shortest(candidates, parts, tree);
  while (parts.count() > 1) {
    candidates = shortest_edges_out(points, parts);
    take_shortest(candidates, parts, tree);
  }
  std::sort(tree.begin(), tree.end(), shorter);
  return tree;
}

}  // namespace instep
