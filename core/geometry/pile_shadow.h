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

/// Marks points that stand before and behind piles: what strays where the skin was seen so many
/// times is as many times too many, and would outnumber the points that stay. Those within the
/// level's shadow, and for three times as far those with less than half the company that points of
/// a skin have: the other side of a body stays. Of those that are not marked yet.
/// O(n log n + points in the shadow of each).
void mark_shadows(const std::vector<Eigen::Vector3d>& points, const std::vector<PileFace>& faces,
                  const PileLevel& level, std::vector<bool>& marked);

}  // namespace instep
