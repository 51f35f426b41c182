#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace instep {

/// The foot below a leg that is far longer than it.
struct FootUnderLeg {
  std::vector<std::size_t> points;  ///< indices, ascending
  double kept_mm = 0.0;             ///< from the sole along the leg
  Eigen::Vector3d up;               ///< along the leg, of length 1
};

/// Most of a leg, with the foot at its end, in any pose: 400 mm and 1.4 times as long as the foot
/// or more, and slim all the way over the ankle. A body of which so little is foot would be taken
/// to lie on its leg. What is kept reaches well over the ankle. Nothing for any other body, and
/// where a floor or a wall lies round it. O(n).
std::optional<FootUnderLeg> foot_under_leg(const std::vector<Eigen::Vector3d>& points);

}  // namespace instep
