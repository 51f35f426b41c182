#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// How far the surface wanders round one place: the variogram of its height, once curvature is
/// taken out, is roughness * distance^3. A crease is rough, an even curve is not.
struct LocalRoughness {
  Eigen::Vector3d place;
  double roughness = 0.0;
};

/// How much of the unevenness of a cloud is noise and how much is shape.
struct NoiseEstimate {
  double sigma = 0.0;  ///< standard deviation of a point along its normal
  std::vector<LocalRoughness> roughness;
};

/// Estimates both from the neighbourhoods of some of the points (`places`, some 24 to 47 of them
/// are used, or every third of those where these are all of exact points), each taken as heights
/// over its own tangent plane: restricted maximum likelihood with the kernel r^3, which tells white
/// noise from wandering shape by its scale. The noise is the middle one over the neighbourhoods, so
/// that creases and a few stray ones do not count. If `sigma` is known, only the roughness is
/// estimated.
NoiseEstimate estimate_noise(const std::vector<Eigen::Vector3d>& points, const PointIndex& index,
                             const std::vector<std::size_t>& places, std::optional<double> sigma);

/// The roughness at a place, from the nearest ones; a small positive number if there are none.
double roughness_at(const std::vector<LocalRoughness>& known, const Eigen::Vector3d& place);

}  // namespace instep
