#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/piles/pile_level.h"

namespace instep {

/// What is to stay of points that have piles.
struct LevelledPoints {
  std::vector<bool> surplus;   ///< those that are more than are needed
  std::vector<double> errors;  ///< of those of piles that stay, > 0; 0 of others
};

/// Leaves points as far apart in piles as they are elsewhere. Where a column of a pile's skin, as
/// wide as usual points are apart, holds more than two times as many as is usual, one stays: of
/// those with the least of `doubts` the one nearest to the skin that all round it show, so that
/// their noise averages out and an exact point stays exact. Its error is how far it lies from that
/// skin and how well that is known: three times the standard deviation, for points beside each
/// other share it, which would otherwise pass for shape. Of two that are too near to each other one
/// stays, none beside a full column, and of a heap that is no skin the middle.
///
/// What stands before and behind a pile within its shadow is surplus if it has too little company
/// for skin: strays of the many points that see it, as many times too many.
///
/// `doubts`: for each point, as its noise; or none, if all are alike. O(n log n).
LevelledPoints levelled(const std::vector<Eigen::Vector3d>& points, const PileLevel& level,
                        const std::vector<double>& doubts);

}  // namespace instep
