#pragma once

#include <optional>
#include <vector>

#include "core/girth/band/plane_band.h"
#include "core/girth/section/section_loops.h"

namespace instep {

/// Loops so near to a section that nothing tells whether they are parts of its body, as a fin whose
/// root is too thin for the points. In the band's unit.
struct LoopsBeside {
  /// From the section to each other loop, in their order; none to one that is far off.
  std::vector<std::optional<double>> gaps;
  /// How much longer the section may be with those that are thin or small, as fins and ribs are and
  /// toes and other bodies are not.
  double contact = 0.0;
  double stretched = 0.0;
};

/// `loops`: all that the plane cuts, the section first. O(corners of the others).
LoopsBeside loops_beside(const PlaneBand& band, const std::vector<SectionLoop>& loops);

}  // namespace instep
