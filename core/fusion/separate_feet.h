#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace instep {

struct SeparatedFeet {
  std::vector<std::vector<std::size_t>> feet;  ///< indices of points, ascending; larger foot first
  std::size_t strays = 0;                      ///< points that belong to no foot
  std::vector<std::string> warnings;
};

/// Tells one or two feet from each other and from what is left of legs, background and floor.
/// `positions` are in the station frame, z up, without platform.
///
/// Points that touch form pieces; pieces are joined, nearest first, as long as the joined one still
/// fits into a foot's rectangle, 350 mm by 155 at most (and two pieces that look like feet are
/// never joined side by side); a piece too wide for a foot, or for its own length and thin
/// somewhere between two feet, is split where it is thinnest. Then small pieces go to the foot
/// whose outline they lie in, and everything else is stray; where such a thing stands and could be
/// a part of a foot, too far away to be joined, or is only too short for a foot, a warning says so.
/// No foot gives an empty list, and a warning where something stands there that is shorter.
SeparatedFeet separate_feet(const std::vector<Eigen::Vector3d>& positions,
                            double standing_height_mm);

}  // namespace instep
