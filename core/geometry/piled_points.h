#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace instep {

/// Points pile up where a part was seen many times as densely as the rest: a spot that one camera
/// saw a thousand times, or a side that a second one saw from near. Most of the points, they have
/// the say on how far apart all are and how noisy, and where they end no patch of the nearest ones
/// sees both sides. Of a body with 0.3 mm of noise, a thirtieth of which was seen eighty times as
/// densely with 0.1 mm, girths were up to 21 mm too long.

/// What the skin beside piles shows in cubic cells.
struct PileLevel {
  double side = 0.0;   ///< of a cell: so wide that most of those of the skin have points
  double usual = 0.0;  ///< points of a piece of skin as large as a cell's face
};

/// The level of points that have piles; nothing where they have none. `points` lie round `middle`,
/// on a ring that is `height` > 0 high along z. `least_side` > 0 of the cells; wider where points
/// are further apart, or where the noise of a pile is thicker.
///
/// The usual density is that of the sparser third of all directions round the middle: a pile that
/// covers half of the body does not count, nor do strays where the skin lies all round. Nothing
/// where that is so sparse that it is no skin. O(n log n).
std::optional<PileLevel> level_beside_piles(const std::vector<Eigen::Vector3d>& points,
                                            const Eigen::Vector2d& middle, double height,
                                            double least_side);

/// Which points are more than are needed. In cells of piles one point stays: of those with the
/// least of `doubts` the one nearest to the skin that all round it show, so that their noise
/// averages out and an exact point stays exact. None does in the fringe of a pile. `doubts`: for
/// each point, as its noise; or none, if all are alike. O(n log n).
std::vector<bool> surplus_in_piles(const std::vector<Eigen::Vector3d>& points,
                                   const PileLevel& level, const std::vector<double>& doubts);

}  // namespace instep
