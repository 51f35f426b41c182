#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/fusion/frames/deprojector.h"
#include "core/fusion/frames/depth_frame.h"
#include "core/fusion/frames/temporal_fusion.h"
#include "core/fusion/poses/bent_depths.h"
#include "core/geometry/point_cloud.h"
#include "core/go_on.h"
#include "core/result.h"
#include "core/workers.h"

namespace instep {

/// What one camera saw.
struct View {
  CameraGeometry geometry;
  FusedDepth depth;
  /// The camera's rays, if the caller keeps them; else they are computed anew (2 to 20 ms), in the
  /// view's own job.
  std::shared_ptr<const Deprojector> rays;
};

struct FusionSettings {
  double point_spacing_mm = 1.0;
  std::optional<double> platform_height_mm;  ///< z of the standing surface, station frame
  /// Fit the views to each other, their poses and by how much their lenses stretch what they see;
  /// else both are trusted, with a warning if poses are wrong.
  bool refine_views = true;
};

/// How the fusion went, in figures.
struct FusionDiagnostics {
  std::size_t views_used = 0;
  bool platform_found = false;
  double platform_tilt_deg = 0.0;
  double registration_before_mm = 0.0;  ///< median distance between the views by the given poses
  double registration_after_mm = 0.0;   ///< the same by those that were used
  /// Of the distances between the views, what the noise of the points does not explain, one sigma.
  double unexplained_mm = 0.0;
  BentDepths bent;            ///< in which neighbours are alike
  double poses_off_mm = 0.0;  ///< of the view whose given pose is worst, across the skin it shares
  /// Of the view that was stretched most, by what share; nothing where lenses are trusted.
  std::optional<double> lenses_off;
};

/// The feet on the platform. Station frame, levelled: z up, the standing plane level at z =
/// standing_height_mm.
struct FusedScene {
  std::vector<PointCloud> feet;  ///< one or two, the larger first; cut off 150 mm above the plane
  double standing_height_mm = 0.0;
  /// Given, or seen as a platform; else it is that of the lowest that was seen of the feet.
  bool is_standing_height_known = false;
  FusionDiagnostics diagnostics;
  std::vector<std::string> warnings;                    ///< of the scene as a whole
  std::vector<std::vector<std::string>> foot_warnings;  ///< of each foot
};

/// From one depth image a camera to the clouds of the feet, each with normals, sigma, view
/// directions, origins, where overlaps show that depths are bent the errors that neighbours share
/// (LocalErrors) and, where the views were refined, those that are left of their poses and lenses
/// (PointCloud::shared_errors_mm). Pure computation; the same views give the same bytes, in
/// whatever order (they are taken by name, which differ). What concerns one view alone is a job of
/// its own for `workers`, the rest runs on the calling thread. `go_on` hears of each view, each
/// iteration of the registration, and each stage.
///
/// Fails with kInvalidInput where a pose or lens is not sound or there is no view, kCorruptData
/// where a depth image does not fit its camera, kInsufficientData where no camera saw anything,
/// where views see through each other's feet even without the one that is contradicted most, or no
/// foot stands there, kCancelled. A camera that saw nothing while others did, or was left out so,
/// is a warning.
Result<FusedScene> fuse_views(const std::vector<View>& views, const FusionSettings& settings = {},
                              const Workers& workers = one_after_the_other,
                              const GoOn& go_on = always);

}  // namespace instep
