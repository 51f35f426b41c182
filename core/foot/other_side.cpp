#include "core/foot/other_side.h"

#include <utility>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"

namespace instep {

std::optional<RedrawnLandmarks> landmarks_of_other_side(const FootScan& foot) {
  if (foot.is_side_sure()) return std::nullopt;
  FootScan other;
  other.cloud = foot.cloud;
  other.side = other_side(foot.side);
  other.is_floor_known = foot.is_floor_known;
  other.rules = foot.rules;
  for (const char* name : {"pternion", "acropodion", "toe2_tip"}) {
    const auto found = foot.landmarks.find(name);
    if (found != foot.landmarks.end()) other.landmarks.insert(*found);
  }
  // Where the points do not show the axis of its rules, both have the one that was found.
  (void)realign(other);
  mark(other);
  return RedrawnLandmarks{std::move(other.landmarks), other.foot_from_input.inverse()};
}

}  // namespace instep
