#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/foot/foot_scan.h"

namespace instep {

/// The ends of a foot where its skin runs on and only the points end (end_facing()), as of a foot
/// that reached out of view, or where it has a hole: it is longer, by nobody knows how much.
struct UnseenEnds {
  std::string warning;
  /// The landmarks as they would be if it went on: at the toes for another 10 mm, where more was
  /// cut off the warning alone tells; at the heel for as much as its skin, which is about as round
  /// on all feet, lacks of facing backwards, at least 10 mm where it has a hole and 25 at most,
  /// and with its axis turned. Each of these for itself.
  std::vector<RedrawnLandmarks> if_longer;
};

/// Nothing of a foot that was seen whole, of one of which only some millimetres were cut off, as a
/// rule, and of a last, the front of which may be an edge. `foot` has its landmarks. The first
/// toe is asked for itself: where it was cut off, the second one's skin may be the foremost.
/// O(points), and once more the cost of the landmarks for each entry, without redraws.
std::optional<UnseenEnds> unseen_ends(const FootScan& foot);

}  // namespace instep
