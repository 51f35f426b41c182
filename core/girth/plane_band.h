#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/girth/tape_plane.h"
#include "core/result.h"
#include "core/surface/noise_estimate.h"
#include "core/surface/oriented_point.h"

namespace instep {

/// The points near a tape plane, made ready for a surface: seen from the plane (x and y on it, z
/// above it), in a unit of their own so that results scale exactly with the cloud, duplicates and
/// strays gone, noisy crowds averaged, normals pointing outwards.
struct PlaneBand {
  double unit_mm = 1.0;       ///< length of the unit
  Eigen::Vector2d middle_mm;  ///< in the plane's coordinates; the origin of the band's
  std::vector<OrientedPoint> points;
  std::vector<bool> seen;                 ///< whether any member of an averaged point was seen
  double spacing = 0.0;                   ///< between points, in the unit
  double sigma = 0.0;                     ///< noise of the points as they came, in the unit
  std::vector<LocalRoughness> roughness;  ///< in the unit
  std::size_t used = 0;                   ///< points of the cloud in the band

  Eigen::Vector2d to_plane(const Eigen::Vector2d& place) const {
    return middle_mm + unit_mm * place;
  }
};

/// Fails with kInsufficientData for too few points, kInvalidInput for a plane that has none near it
/// or all on one side.
Result<PlaneBand> band_at(const PointCloud& cloud, const TapePlane& plane,
                          std::optional<double> sigma_mm);

}  // namespace instep
