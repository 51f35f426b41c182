#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/foot/foot_scan.h"

namespace instep {

/// The ends of a foot where its skin runs on and only the points end (end_facing()), as of a foot
/// that reached out of view: it is longer, by nobody knows how much.
struct UnseenEnds {
  std::string warning;
  /// The landmarks as they would be if it went on for another 10 mm: of each end for itself. Where
  /// more was cut off, the warning alone tells.
  std::vector<RedrawnLandmarks> if_longer;
};

/// Nothing of a foot that was seen whole, of one of which only some millimetres were cut off, as a
/// rule, and of a last, the front of which may be an edge. That a foot without its heel may have
/// another axis is not in it. `foot` has its landmarks. O(points), and once more the cost of the
/// landmarks for each end, without redraws.
std::optional<UnseenEnds> unseen_ends(const FootScan& foot);

}  // namespace instep
