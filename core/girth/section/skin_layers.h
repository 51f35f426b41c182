#pragma once

#include <numbers>
#include <optional>
#include <vector>

#include "core/girth/band/plane_band.h"
#include "core/surface/patches/blended_surface.h"

namespace instep {

/// Two layers of points over the surface that was laid between them: their mean heights.
struct SkinLayers {
  double inner = 0.0;  ///< the lower one
  double outer = 0.0;
  double turn = 2.0 * std::numbers::pi;  ///< the directions in which they may lie, at most
  bool are_all_round = true;             ///< wherever it was looked
};

/// Whether heights of points over one surface fall into two heaps, as those of a skin and of a sock
/// over it do, or of two scans of one body that do not fit: nothing says then where its skin is,
/// and noise that was taken for even hides that. The heights are parted where their two means lie
/// furthest apart for their spread (Otsu 1979); they are two heaps if half-way between the means
/// there are plainly fewer than round them. Noise, of whatever size from place to place, has most
/// there, and rounding as many as elsewhere.
///
/// Nothing for fewer than some dozens of heights, where a heap has less than a tenth of them, and
/// for layers less than four of their own deviations apart, or less than five if one has three
/// points in ten: they look like one. O(n log n).
std::optional<SkinLayers> layers_among(std::vector<double> heights);

/// Those of the points within `near` of the tape plane, of which some hundreds are asked: all
/// round, or in some of up to eight sectors, as where two cameras that both see a side do not fit;
/// nothing for layers so near to each other that it does not matter. In the unit of the band.
std::optional<SkinLayers> layers_near_plane(const PlaneBand& band, const BlendedSurface& surface,
                                            double near);

/// A tape on either layer is longer or shorter than one between them by at most this: by its height
/// times their turn, and some more, for what is between follows where there are more of either.
double reach_of(const SkinLayers& layers);

}  // namespace instep
