#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/fusion/deprojector.h"
#include "core/fusion/temporal_fusion.h"
#include "core/geometry/point_cloud.h"

namespace instep {

/// Which pixels of a depth image are trusted to lie on a surface.
struct SurfaceSettings {
  /// A step in depth between neighbours that no surface makes: steeper than this against the line
  /// of sight and larger than `jump_sigmas` of its noise.
  double steepest_deg = 80.0;
  double jump_sigmas = 5.0;
  double unsteady = 4.0;  ///< times the usual noise: a pixel that wavers so from frame to frame
  int erosion_px = 1;     ///< further pixels dropped on both sides of a jump
  /// Share of the 7 x 7 pixels round one that must hold data: where a silhouette has nothing
  /// behind it, the outermost pixels are as doubtful. The default takes two off a straight rim.
  double least_filled_window = 0.74;
  double most_incidence_deg = 75.0;  ///< between normal and line of sight
  double normal_error_deg = 4.0;     ///< wanted; sets the size of the window a normal is fitted in
};

/// Takes away the pixels on both sides of a silhouette, where a camera mixes foreground and
/// background into points that float between them, those on the rim of what it saw, and those
/// that waver.
void drop_flying_pixels(const CameraIntrinsics& intrinsics, const SurfaceSettings& settings,
                        FusedDepth& depth);

/// The points of the given pixels in the camera frame, with normals, sigma along the normal, and
/// view directions. A normal comes from the plane that fits the inverse depth of a window best
/// (inverse depth is linear in the ray for a plane, and its noise is even); neighbours off the
/// plane, as beyond a crease, are left out in a second pass. Pixels whose normal stands too
/// slantwise or is not defined are dropped. About 0.5 us a pixel.
PointCloud surface_points(const Deprojector& deprojector, const FusedDepth& depth,
                          const std::vector<std::uint32_t>& pixels,
                          const SurfaceSettings& settings);

}  // namespace instep
