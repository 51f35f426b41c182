#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace instep {

/// Tip of the second toe in the floor plane.
struct SecondToe {
  Eigen::Vector2d tip = Eigen::Vector2d::Zero();
  bool is_resolved = false;  ///< seen as a toe of its own, not placed by proportion
};

/// Share of the ball's breadth from the medial border at which the second toe's tip is taken to be
/// where the toes cannot be told apart (in a sock, or in a coarse cloud): the mean of drawn feet.
inline constexpr double kSecondToeShare = 0.415;

/// Finds the second toe's tip on the front border: of the toes that show, the one that is the
/// second by where all of them lie (second_of_toes()) and has room for the big one beside it; else
/// the front border at kSecondToeShare.
///
/// Toes recede towards the little one, so that a toe seldom stands out forwards; they are told
/// apart by the clefts between them, seen square to the line of their tips. The tip is the foremost
/// point of the toe so found.
///
/// `outline`: the outline's points from above at full size (full_size.h), x to the toes, medial
/// side on +y, rear end near x = 0. Nothing where there is no border in front.
std::optional<SecondToe> find_second_toe(const std::vector<Eigen::Vector2d>& outline,
                                         double length_mm);

}  // namespace instep
