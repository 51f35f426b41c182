#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace instep {

/// Two points and the distance between them.
struct TreeEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  double length = 0.0;
};

/// A minimum spanning tree of points under Euclidean distance, shortest edge first: one edge fewer
/// than points, none for fewer than two. The paper takes the shortest edge for the distance of
/// off-surface points (section 3.2) and the longest for the widest space between points (sections
/// 3.4 and 5).
///
/// Kruskal over the graph of each point's nearest neighbours; the parts that this graph leaves are
/// then joined by the shortest edges between them (Boruvka), found exactly. Equal lengths are
/// ordered by index, so the tree does not depend on the search. Coordinates must be finite; at most
/// 2^32 - 1 points. O(n log n) for one body, a factor log^2(parts) more for scattered ones.
std::vector<TreeEdge> minimum_spanning_tree(const std::vector<Eigen::Vector3d>& points);

}  // namespace instep
