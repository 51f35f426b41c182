#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sim/solids/round_cone.h"

namespace instep {

/// A smooth union of round cones: the soft minimum -k ln(sum exp(-d/k)) of their distances, which
/// is smooth wherever they meet and fills the corners between them over a width of about 3 k.
class Blend {
 public:
  explicit Blend(double softness_mm) : softness_(softness_mm) {}

  void add(const RoundCone& cone) { cones_.push_back(cone); }

  /// Negative inside; changes by at most 1 a millimetre; below the distance to the skin outside.
  double value(const Eigen::Vector3d& point) const;

  /// Holds the union with its filled corners.
  Eigen::AlignedBox3d bounds() const;

 private:
  double softness_;
  std::vector<RoundCone> cones_;
};

/// Smooth union of two values.
double soft_minimum(double a, double b, double softness);

/// What two values enclose together, its edge rounded with radius `radius` (exactly so where their
/// skins meet at a right angle). Zero radius gives a sharp edge.
double rounded_maximum(double a, double b, double radius);

}  // namespace instep
