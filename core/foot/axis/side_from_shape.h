#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/foot/side.h"

namespace instep {

/// Which foot a shape is, and how sure that is.
struct SideGuess {
  Side side = Side::kRight;
  double confidence = 0.5;  ///< 0.5 (a coin) to 1
};

/// Tells left from right by what every foot has: the toes end on the medial side of the line from
/// heel to ball, the arch hollows the medial border, and the ball protrudes further forward on the
/// medial side (0.69 of the length against 0.63). Each is weighed by how clear it is.
///
/// `points` stand on z = 0 with the heel at the origin and the toes at x = `length_mm`, about the
/// axis of the outline. A mirrored shape gives the other side with the same confidence.
SideGuess side_from_shape(const std::vector<Eigen::Vector3d>& points, double length_mm);

/// The same guess, not sure (kSureSide) where more than 0.15 of either border was not seen
/// (skin_round.h): then its hollow and its ball are those of a rim. Of a body that was cut off, not
/// of one on a platform, under which walls were put: of those two or three cameras tell as much as
/// kSureSide says. O(n).
SideGuess guess_by_seen_borders(SideGuess guess, const std::vector<Eigen::Vector3d>& points,
                                double length_mm);

}  // namespace instep
