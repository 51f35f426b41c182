#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/piles/pile_level.h"

namespace instep {

/// A place of a pile, and across its skin.
struct PileFace {
  Eigen::Vector3d place;
  Eigen::Vector3d normal;
};

/// Marks points that stand before and behind piles and are of no skin: with less than half the
/// company that a skin has, or with company that does not lie flat. What strays where the skin was
/// seen so many times is as many times too many, and would outnumber the points that stay. A skin
/// that faces the pile stays. Of those that are not marked yet. O(n log n), what stands in the
/// shadow of each face, and the company of each point that does.
void mark_shadows(const std::vector<Eigen::Vector3d>& points, const std::vector<PileFace>& faces,
                  const PileLevel& level, std::vector<bool>& marked);

}  // namespace instep
