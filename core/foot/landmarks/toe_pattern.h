#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace instep {

/// Which of some tips of toes is the second toe's, told from where all of them lie: the place of
/// one alone says little, since feet splay and the axis that places are counted from is itself
/// found by that toe.
///
/// `shares`: where each tip lies between the medial border of the ball (0) and its lateral one (1),
/// in any order. Some may be no tips at all, and toes may be missing: the big one seldom stands out
/// when looked at square to the others. Of all ways to name them in their order, the likeliest is
/// taken: tips of the average foot, shifted and stretched a little, each a little off, with a
/// price for each toe that is missing and each tip that is none. Nothing where the second toe is
/// not among them, fewer than four toes show, even the likeliest is unlikely, or another that has
/// another second toe is hardly less so: a short second toe hides beside a big one that lies where
/// second toes do. `may_be_second`: of each tip, as
/// many as these, false where something tells that it is not. Of
/// more than eight tips nothing is told; eight take a sixth of a millisecond.
std::optional<std::size_t> second_of_toes(const std::vector<double>& shares,
                                          const std::vector<bool>& may_be_second);

}  // namespace instep
