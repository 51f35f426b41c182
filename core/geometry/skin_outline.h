#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// How the skin lies round a middle, by 64 directions, and how densely it was seen.
struct SkinOutline {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> places;  ///< the median of each direction that has points
  /// Points for each square unit of the skin; 0 where none lies beside the middle. That of the
  /// sparser third of all directions, so that neither a part that was seen many times as densely
  /// counts, up to half of the body, nor strays where the skin lies all round.
  double density = 0.0;
};

/// `points` of a ring that is `height` > 0 high along z. The middle is that of the outline itself,
/// found by some rounds. In cells of `side` > 0, far narrower than the ring is wide, no more points
/// count for it than ten times what half of the cells hold: seen from near the skin most points
/// would lie in few directions. O(n log n).
SkinOutline outline_of_skin(const std::vector<Eigen::Vector3d>& points, double height, double side);

}  // namespace instep
