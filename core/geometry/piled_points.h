#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace instep {

/// Points pile up where a cell holds many times as many as others do: a spot that one camera saw a
/// thousand times, or a strip that a second one saw from near. Most of the points, they have the
/// say on how far apart all are and how noisy, and where they end no patch of the nearest ones sees
/// both sides. Of a body with 0.3 mm of noise, a thirtieth of which was seen eighty times as
/// densely with 0.1 mm, girths were up to 21 mm too long.

/// How many points cells hold where some are piles: what three quarters of them hold at most.
/// Nothing where none is. `counts`: of points, for each cell that has some. O(n).
std::optional<std::size_t> usual_beside_piles(const std::vector<std::size_t>& counts);

/// Which points are too many in their cubic cell of `side` > 0: `usual` > 0 stay, spread evenly
/// over the order of the points. So at the foot of a pile too, or it would be the next one. O(n log
/// n).
std::vector<bool> piled_points(const std::vector<Eigen::Vector3d>& points, double side,
                               std::size_t usual);

}  // namespace instep
