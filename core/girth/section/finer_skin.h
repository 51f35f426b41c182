#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/girth/band/plane_band.h"
#include "core/girth/contour/contour_index.h"
#include "core/surface/patches/blended_surface.h"
#include "core/surface/ribbon/ribbon_spline.h"

namespace instep {

/// Waves or ribs of skin that are finer than the surface through its points follows, however thick
/// the noise.
struct FinerSkin {
  double height = 0.0;  ///< root mean square
  double slope = 0.0;   ///< the same, along the line
  /// What noise may have taken of both, if points are off along the line as much as across it: so
  /// many times as high waves would show as these do.
  double blur = 1.0;
};

/// What a line without them is too short by, at most: one laid half-way up, if they are waves.
struct MissedLength {
  double contact = 0.0;
  double stretched = 0.0;  ///< of a tape over their tops
};
MissedLength missed_length(const FinerSkin& skin, double length);

/// From heights over a surface that was laid through their points: what they share with others
/// further along the line. Noise that is independent from place to place shares nothing, however
/// uneven it is; waves do, by the cosine of their way (the autocovariance, and the cosine that fits
/// it most plainly). What is nearer than a 1600th of the line does not count: it may be one place
/// seen twice, or one line of a scanner.
///
/// Waves are sought from the `longest`, at most 6 % of the line, down to 0.5 %. `across`: columns
/// side by side, of offs from -1 to 1; only heights of the same one are compared: of one all, which
/// shows ribs along the body most plainly, of many ribs that run aslant as well. Nothing where none
/// show plainly, as of too few points. O(points + columns), and the products of rows near by.
std::optional<FinerSkin> finer_skin_of(const std::vector<RibbonPoint>& heights, double length,
                                       double longest, std::size_t across);

/// What points show that is finer than a spline through them can follow.
std::optional<FinerSkin> finer_skin_over(const RibbonSpline& spline,
                                         const std::vector<RibbonPoint>& points, double length);

/// What the points of a band show along a section that was traced on `surface`; some thousands next
/// to the plane are asked. In the unit of the band. O(points).
std::optional<FinerSkin> finer_skin_at(const PlaneBand& band, const BlendedSurface& surface,
                                       const ContourIndex& section);

/// Whether all coordinates are rounded so coarsely that the waves may be steps of that. Of a cloud
/// that was turned since, as a foot is into its own frame, nothing tells. O(n log n).
bool may_be_rounding(const FinerSkin& skin, double unit_mm, const PointCloud& cloud);

}  // namespace instep
