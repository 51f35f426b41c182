#pragma once

#include "core/girth/band/plane_band.h"
#include "core/girth/section/section_loops.h"

namespace instep {

/// Points near the plane that crowd beside one stretch of a section but not on it, as of a slot, a
/// groove or a rib too narrow for the surface through them, and how much longer the section may be
/// with them. In the band's unit; nothing where there are too few.
struct NarrowPart {
  double off = 0.0;  ///< how far its points lie from the section
  double contact = 0.0;
  double stretched = 0.0;

  bool is_any() const { return off > 0.0; }
};

/// The one with the most points. Those off by no more than noise, the lean of the skin or an edge
/// explains do not count, nor those far off, which may be another body's or strays. O(n log n) for
/// the points of the band.
NarrowPart narrow_part_beside(const PlaneBand& band, const SectionLoop& section);

}  // namespace instep
