#pragma once

#include <cstddef>
#include <vector>

#include "core/surface/ribbon_spline.h"

namespace instep {

/// Whether points show skin that is finer than a spline through them can follow, as waves or ribs
/// between its knots, however thick the noise: their mean heights over it, in cells of a sixth of
/// the way from knot to knot and a fifth of the ribbon, differ more than they scatter within these
/// (one-way analysis of variance). Of 3,000 drawn ribbons without it none seems to. False
/// of points too few to have several in a cell.
///
/// `length`: of the line; `knots`: along it. O(points).
bool shows_finer_skin(const std::vector<RibbonPoint>& points, const RibbonSpline& spline,
                      double length, std::size_t knots);

}  // namespace instep
