#pragma once

#include <cmath>
#include <numbers>

#include "core/girth/contour/contour.h"

namespace instep::test {

/// Corners evenly round a circle about the origin, counter-clockwise from the x axis.
inline Contour circle_contour(double radius, int corners) {
  Contour contour;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    contour.outward.emplace_back(std::cos(angle), std::sin(angle));
    contour.points.push_back(radius * contour.outward.back());
  }
  return contour;
}

}  // namespace instep::test
