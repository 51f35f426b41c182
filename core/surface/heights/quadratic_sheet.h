#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/surface/heights/height_base.h"
#include "core/surface/heights/height_samples.h"
#include "core/surface/oriented_point.h"

namespace instep {

/// The quadratic that fits points best, as heights over the plane that faces outwards: a
/// HeightPatch in the rough, at a fraction of its cost. The flattest of many if the points
/// determine none, as those on one line or two.
class QuadraticSheet {
 public:
  /// At least six points. `outward`: a unit vector. O(points).
  QuadraticSheet(const std::vector<OrientedPoint>& points, const Eigen::Vector3d& outward,
                 const Eigen::Vector3d& centre, double radius);

  /// Height over the sheet, and its gradient.
  FieldValue at(const Eigen::Vector3d& position) const;

 private:
  HeightBase base_;
  Quadratic terms_;
};

}  // namespace instep
