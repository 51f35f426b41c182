#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/surface/oriented_point.h"
#include "core/surface/patches/height_patch.h"

namespace instep {

/// A smooth sheet over points, and those of them that it is fitted to.
struct StrayFreeSheet {
  HeightPatch patch;
  std::vector<std::size_t> numbers;  ///< among the points, ascending

  /// Fits a sheet to all points but the few that the others plainly do not tell: strays that lie
  /// near the skin. Of exact or few points these are also bumps of fewer than about four of them,
  /// which cannot be told from strays. Where points are averaged over cells a stray is off the
  /// sheet without its cell while most of the cell is not; if most is, the skin is bent there and
  /// no more is left out, of other cells neither.
  ///
  /// `fit_to`: as HeightPatch::fit(), with all but the points bound. Nothing if it gives nothing
  /// for all of them. Calls it once if there is no stray, up to nine times else.
  using FitTo = std::function<std::optional<HeightPatch>(const std::vector<OrientedPoint>&)>;
  static std::optional<StrayFreeSheet> of(const std::vector<OrientedPoint>& points,
                                          const FitTo& fit_to);
};

}  // namespace instep
