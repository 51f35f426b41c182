#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/girth/contour_index.h"
#include "core/girth/plane_band.h"
#include "core/surface/blended_surface.h"
#include "core/surface/ribbon_spline.h"

namespace instep {

/// Waves or ribs of skin that are finer than the surface through its points follows, however thick
/// the noise: what they leave of the heights over it goes together in places where noise does not.
struct FinerSkin {
  double height = 0.0;  ///< root mean square
  double slope = 0.0;   ///< the same, along the line
};

/// What a line without them is too short by, at most: one laid half-way up, if they are waves.
struct MissedLength {
  double contact = 0.0;
  double stretched = 0.0;  ///< of a tape over their tops
};
MissedLength missed_length(const FinerSkin& skin, double length);

/// From heights over a surface that was laid through their points. In cells of the way along the
/// line, and of what is off the plane, the product of two points' heights is nothing on the mean if
/// they are noise, however uneven, and the square of skin that they share. Cells are tried from a
/// hundredth of the line down to a point or two each, and those that show it most plainly tell it;
/// what goes on from one to the next tells how steep it is. Nothing where none show it plainly, as
/// of too few points: of 3,000 drawn ribbons without it six do.
///
/// `length`: of the line; `across`: cells side by side, of offs from -1 to 1. O(points).
std::optional<FinerSkin> finer_skin_of(const std::vector<RibbonPoint>& heights, double length,
                                       std::size_t across);

/// What points show that is finer than a spline through them can follow.
std::optional<FinerSkin> finer_skin_over(const RibbonSpline& spline,
                                         const std::vector<RibbonPoint>& points, double length);

/// What the points of a band show along a section that was traced on `surface`; some thousands next
/// to the plane are asked. In the unit of the band. O(points).
std::optional<FinerSkin> finer_skin_at(const PlaneBand& band, const BlendedSurface& surface,
                                       const ContourIndex& section);

}  // namespace instep
