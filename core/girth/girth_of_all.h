#pragma once

#include "core/geometry/point_cloud.h"
#include "core/girth/girth.h"
#include "core/girth/tape_plane.h"
#include "core/girth/told_girth.h"
#include "core/result.h"

namespace instep {

/// The girth of a cloud that passed check_cloud(), all points near the plane taken together: as
/// girth_by_rbf(), but that looks at bodies alone and over openings, and adds what the points'
/// shared errors leave open.
///
/// Where patches are laid and the contour is traced hangs on u and v, which the plane has by
/// chance. Lengths that are sure do not: they differ by some millionth. One that leaves doubt is
/// read once more with both turned. Its interval reaches that reading too, and what refuses
/// that one refuses it. If nothing closes there, that says nothing. A sure one that one even skin
/// contradicts (smooth_section()) gives way to the other reading if that is of such a skin: of 800
/// noisy smooth bodies one has a patch that noise has folded, and was 2.5 sigma too long.
Result<ToldGirth> girth_of_all(const PointCloud& cloud, const TapePlane& plane,
                               const GirthOptions& options);

}  // namespace instep
