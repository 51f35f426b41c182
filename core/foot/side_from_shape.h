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
/// medial side (0.69 of the length against 0.63). Each is weighed by how clear it is. Where more
/// than 0.15 of either border was not seen (skin_round.h) the side is not sure (kSureSide). O(n).
///
/// `points` stand on z = 0 with the heel at the origin and the toes at x = `length_mm`, about the
/// axis of the outline. A mirrored shape gives the other side with the same confidence.
SideGuess side_from_shape(const std::vector<Eigen::Vector3d>& points, double length_mm);

}  // namespace instep
