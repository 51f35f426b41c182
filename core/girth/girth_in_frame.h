#pragma once

#include "core/geometry/point_cloud.h"
#include "core/girth/band/plane_band.h"
#include "core/girth/girth.h"
#include "core/girth/section/section_evidence.h"
#include "core/girth/section/smooth_section.h"
#include "core/girth/tape_plane.h"
#include "core/girth/told_girth.h"
#include "core/result.h"
#include "core/surface/patches/blended_surface.h"

namespace instep {

/// The girth of a cloud that passed check_cloud(), all points near the plane taken together, as the
/// plane's u and v let a surface through them run; see girth_of_all().
Result<ToldGirth> girth_in_frame(const PointCloud& cloud, const TapePlane& plane,
                                 const GirthOptions& options);

/// What the patches of a surface tell of a contour on it (doubt_of()), whose points are `sigma`
/// off.
MeasuredSection section_by_patches(const Contour& contour, const BlendedSurface& surface,
                                   double sigma);

/// What a section of that band tells, in millimetres and on the plane; without the number of the
/// cloud's points, and without warnings.
Girth girth_of(const PlaneBand& band, const MeasuredSection& section,
               const SectionEvidence& evidence);

}  // namespace instep
