#pragma once

#include "core/geometry/point_cloud.h"
#include "core/girth/band/plane_band.h"
#include "core/girth/contour/contour.h"
#include "core/surface/patches/blended_surface.h"

namespace instep::test {

/// The largest loop of a cloud at the level plane, in its unit, and the surface that it lies on.
struct TracedSection {
  explicit TracedSection(const PointCloud& cloud);

  double spacing;
  BlendedSurface surface;
  Contour contour;

  /// The same line from so many corners further on.
  void begin_later(int corners);

 private:
  explicit TracedSection(PlaneBand band);
};

}  // namespace instep::test
