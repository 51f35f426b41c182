#pragma once

#include <cstddef>
#include <vector>

#include "core/girth/band/plane_band.h"
#include "core/girth/section/section_loops.h"

namespace instep {

/// Skin that hangs together with a section but that no traced loop follows, as a fin or a rib that
/// is thin against the points' distances and was cut off at its root: how much longer the section
/// may be with it, at most. In the band's unit; nothing where all is followed.
struct UnfollowedSkin {
  std::size_t points = 0;  ///< of the band that lie off the section, be they skin or strays
  double off = 0.0;        ///< how far its points lie from the section
  double contact = 0.0;    ///< along all of it and back again
  double stretched = 0.0;  ///< of a tape round it as well

  bool is_any() const { return off > 0.0; }
};

/// Skin is told by points close to the plane that lie off all loops by more than noise, or an edge
/// between the plane and them, explains, that have as many neighbours as skin has, and that begin
/// no further from the section than points on it from each other. So strays do not count, nor other
/// bodies but such as touch it; those cannot be told from a part of it. Where such points lead on
/// to another loop, that counts with them.
///
/// `loops`: all that are followed, the section first. O(points), and n log n for the n that lie
/// beside the section.
UnfollowedSkin unfollowed_skin(const PlaneBand& band, const std::vector<SectionLoop>& loops);

}  // namespace instep
