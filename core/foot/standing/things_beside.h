#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace instep {

/// What stands before the skin of a body, apart from it or touching it.
struct ThingsBeside {
  std::vector<std::size_t> points;  ///< indices, ascending
  double share = 0.0;               ///< of points, over those of the body
  double gap_mm = 0.0;              ///< the least from the body to them; 0 without any
  bool is_gap_seen = false;         ///< the gap is plainly more than the spacing of the points
};

/// Parts points that hang together loosely, first where the room between them is more than their
/// spacing there, then where a skin ends at another one. The largest piece is the body, if it has
/// two fifths of all; another one is a thing beside it if it faces the body's skin: the shortest
/// way to it leaves the skin upright, outwards and within its borders. A part of the body that an
/// unseen strip or an edge cut off lies along the skin, and the far wall of a thin part behind it;
/// both stay, and so do pieces of more than `most_share` of the largest one, and what is smaller
/// than 0.5 %. Where two touch, each point goes with the nearer of what was told apart.
///
/// Of more than 20,000 points as many tell the pieces. O(n log n).
ThingsBeside things_beside(const std::vector<Eigen::Vector3d>& points, double most_share);

}  // namespace instep
