#include "core/foot/landmarks/other_side.h"

#include <utility>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"

namespace instep {

std::optional<RedrawnLandmarks> landmarks_of_other_side(const FootScan& foot) {
  if (foot.is_side_sure()) return std::nullopt;
  FootScan other = aligned_as(foot, foot.shape());
  other.side = other_side(foot.side);
  // Where the points do not show the axis of its rules, both have the one that was found.
  (void)realign(other);
  mark(other);
  return RedrawnLandmarks{std::move(other.landmarks), other.foot_from_input.inverse()};
}

}  // namespace instep
