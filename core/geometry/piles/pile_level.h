#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/piles/skin_block.h"

namespace instep {

/// What the skin beside piles shows in cubic cells.
///
/// Points pile up where a part was seen many times as densely as the rest: a spot that one camera
/// saw a thousand times, or a side that a second one saw from near. Most of the points, they have
/// the say on how far apart all are and how noisy, and where they end no patch of the nearest ones
/// sees both sides. Of a body with 0.3 mm of noise, a thirtieth of which was seen eighty times as
/// densely with 0.1 mm, girths were up to 21 mm too long.
struct PileLevel {
  double side = 0.0;    ///< of a cell: so wide that most of those of the skin have points
  double usual = 0.0;   ///< points of a piece of skin as large as a cell's face, one or more
  double shadow = 0.0;  ///< how far before and behind piles what strays is of them

  /// Whether a cell holds so many times what is usual that it may be of a pile.
  bool is_crowded(std::size_t points_of_cell) const;
  /// Whether the cells of a block are of a pile, or touch one.
  bool is_beside_pile(const CellBlock& block) const;
};

/// The level of points that have piles; nothing where they have none. Piles are cells of thirty
/// times what is usual, or several of eight times whose noise is another than that of the rest: of
/// those of the same noise all tell of the skin, as round the edges of a last.
///
/// `points` and `height`: as outline_of_skin() has them, which tells what is usual; nothing where
/// that is so sparse that it is no skin. `least_side` > 0 of the cells; wider where points are
/// further apart, or where the noise of piles is thicker. O(n log n).
std::optional<PileLevel> level_beside_piles(const std::vector<Eigen::Vector3d>& points,
                                            double height, double least_side);

}  // namespace instep
