#pragma once

#include <optional>
#include <vector>

#include "core/fusion/poses/platform.h"
#include "core/fusion/poses/view_matches.h"
#include "core/fusion/views/working_view.h"
#include "core/geometry/rigid_transform.h"

namespace instep {

/// The platform that views whose poses are known roughly show together: within 40 mm of where it is
/// said to be, else within 120, since the floor about it may be the larger plane; else anywhere, if
/// what else they show lies mostly higher, as it does not about the flat top of an object.
std::optional<FoundPlatform> seen_platform(const std::vector<const WorkingView*>& views,
                                           double height_mm);

/// Level, and at the height that the platform is to have: the new station from the given one.
RigidTransform onto_platform(const FoundPlatform& platform, double height_mm);

/// Variance of the lean of normals, each way (square radians), by those of a level platform: all
/// points within `reach_mm` of its height. 0 where there are none.
double variance_of_level_normals(const std::vector<PosedCloud>& clouds, double height_mm,
                                 double reach_mm);

}  // namespace instep
