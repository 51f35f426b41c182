#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sim/solids/round_cone.h"

namespace instep {

/// A smooth union of round cones: the soft minimum -k ln(sum exp(-d/k)) of their distances, which
/// is smooth wherever they meet and fills the corners between them over a width of about 3 k.
class Blend {
 public:
  static constexpr std::size_t kMostCones = 32;

  explicit Blend(double softness_mm) : softness_(softness_mm) {}

  void add(const RoundCone& cone);

  /// Negative inside; changes by at most 1 a millimetre; below the distance to the skin outside.
  double value(const Eigen::Vector3d& point) const;

  /// The same, with its slope.
  double value(const Eigen::Vector3d& point, Eigen::Vector3d& slope) const;

  /// Holds the union with its filled corners.
  Eigen::AlignedBox3d bounds() const;

 private:
  double softness_;
  std::vector<RoundCone> cones_;  ///< at most kMostCones
};

/// Smooth union of two values. `share` becomes the slope's share of a; b has the rest.
double soft_minimum(double a, double b, double softness, double& share);

/// What two values enclose together, its edge rounded with radius `radius` (exactly so where their
/// skins meet at a right angle); zero gives a sharp edge. The result's slope is `shares`.x() times
/// that of a plus `shares`.y() times that of b.
double rounded_maximum(double a, double b, double radius, Eigen::Vector2d& shares);

}  // namespace instep
