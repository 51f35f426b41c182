#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/fusion/poses/bent_depths.h"
#include "core/geometry/point_cloud.h"

namespace instep {

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

}  // namespace instep
