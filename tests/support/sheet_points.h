#pragma once

#include <vector>

#include "core/surface/oriented_point.h"
#include "core/surface/patches/patch_fitter.h"

namespace instep::test {

/// Of plane_points(), along each axis.
inline constexpr double kSpacing = 0.02;

/// 51 by 51 round the origin; no two of them nearly coincide.
std::vector<OrientedPoint> plane_points(double sigma);

/// Columns of points round a cylinder about z, further from each other than their points.
std::vector<OrientedPoint> cylinder_columns(double radius, int columns, double pitch);

/// With the same likely roughness everywhere.
PatchFitter fitter_of(const std::vector<OrientedPoint>& points);

}  // namespace instep::test
