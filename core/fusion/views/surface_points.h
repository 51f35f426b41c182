#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/fusion/frames/deprojector.h"
#include "core/fusion/frames/temporal_fusion.h"
#include "core/geometry/point_cloud.h"

namespace instep {

/// Takes away the pixels on both sides of a silhouette, where a camera mixes foreground and
/// background into points that float between them, those on the rim of what it saw, and those
/// that waver.
void drop_flying_pixels(const CameraIntrinsics& intrinsics, FusedDepth& depth);

/// The points of the given pixels in the camera frame, with normals, sigma along the normal, and
/// view directions. A normal comes from the plane that fits the inverse depth of a window best
/// (inverse depth is linear in the ray for a plane, and its noise is even); neighbours off the
/// plane, as beyond a crease, are left out in a second pass. Pixels whose normal stands too
/// slantwise (by more than 75 degrees) or is not defined are dropped. About 0.5 us a pixel.
PointCloud surface_points(const Deprojector& deprojector, const FusedDepth& depth,
                          const std::vector<std::uint32_t>& pixels);

}  // namespace instep
