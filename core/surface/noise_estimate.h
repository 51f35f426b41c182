#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// How much of the unevenness of a cloud is noise and how much is shape.
struct NoiseEstimate {
  double sigma = 0.0;      ///< standard deviation of a point along its normal
  double roughness = 0.0;  ///< variogram of the surface's height: roughness * distance^3
};

/// Estimates both from neighbourhoods spread over the points, each taken as heights over its own
/// tangent plane: restricted maximum likelihood with the kernel r^3, which tells white noise from
/// wandering shape by its scale. The middle value over the neighbourhoods counts, so that creases
/// and a few stray ones do not. If `sigma` is known, only the roughness is estimated.
///
/// Needs some 60 points to say something; with fewer it uses what is there.
NoiseEstimate estimate_noise(const std::vector<Eigen::Vector3d>& points, const PointIndex& index,
                             std::optional<double> sigma);

}  // namespace instep
