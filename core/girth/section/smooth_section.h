#pragma once

#include <optional>

#include "core/girth/band/plane_band.h"
#include "core/girth/band/slab_source.h"
#include "core/girth/contour/contour.h"
#include "core/girth/section/finer_skin.h"

namespace instep {

/// A section with its lengths and half-widths of their 95 % intervals, in the unit of the band it
/// comes from.
struct MeasuredSection {
  Contour contour;
  double contact = 0.0;
  double stretched = 0.0;
  double contact_u95 = 0.0;
  double stretched_u95 = 0.0;
  MissedLength missed;           ///< by waves of the skin that it does not follow
  bool is_contradicted = false;  ///< by one even skin through more points
};

/// The section of noisy points where the skin is even: read off one surface through all points
/// within a fifth of the section of the plane, or the nearest 20,000 where no hole is bridged, not
/// off patches of some tens.
/// Noise leaves of a girth what it leaves of a mean, and only points further along the body make
/// more of them: to first order it matters nothing how much is smoothed round the section. RMS
/// errors are 1.2 times what white noise leaves of any local fit, and half of those of the patches
/// (tests/bench/accuracy, noise).
///
/// The patches' contour, made fair, is the line that heights are seen from (FairLine); the heights
/// are a RibbonSpline. That holds for even skin alone: nothing if it bends more from place to place
/// than a tape round it does, turns sharply somewhere (noise blunts a crease, but does not hide
/// it), scatters more round the spline than the noise, or if there is no noise to speak of. Where
/// the points show waves finer than the spline can follow, it says what these add.
///
/// `contour` as traced in the band of these slabs; `is_bridged`: over a stretch without seen
/// points. The points need no normals. O(points of the cloud).
std::optional<MeasuredSection> smooth_section(SlabSource& slabs, const PlaneBand& band,
                                              const Contour& contour, bool is_bridged);

}  // namespace instep
