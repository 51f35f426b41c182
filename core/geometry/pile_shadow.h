#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/pile_level.h"

namespace instep {

/// A place of a pile, and across its skin.
struct PileFace {
  Eigen::Vector3d place;
  Eigen::Vector3d normal;
};

/// Marks points that stand before and behind piles and are of no skin, which has twice as much
/// company or lies flat: what strays where the skin was seen so many times is as many times too
/// many, and would outnumber the points that stay. A skin that faces the pile stays. Of those that
/// are not marked yet. O(n log n + points in the shadow of each).
void mark_shadows(const std::vector<Eigen::Vector3d>& points, const std::vector<PileFace>& faces,
                  const PileLevel& level, std::vector<bool>& marked);

}  // namespace instep
