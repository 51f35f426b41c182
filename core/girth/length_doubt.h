#pragma once

#include "core/girth/contour_trace.h"
#include "core/surface/blended_surface.h"

namespace instep {

/// How far a length read off the surface may be from the true one.
struct LengthDoubt {
  double noise = 0.0;      ///< variance that the noise of the points gives it
  double wandering = 0.0;  ///< variance that the surface between the points gives it
};

/// Of both lengths of a contour on the plane z = 0. To first order a length changes by what the
/// contour moves outwards times what it turns there; a tape that bridges hollows turns only where
/// it touches.
struct ContourDoubt {
  LengthDoubt contact;
  LengthDoubt stretched;
  double wiggle = 0.0;
  double unseen = 0.0;
};

ContourDoubt doubt_of(const Contour& contour, const BlendedSurface& surface);

}  // namespace instep
