#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/surface/oriented_point.h"

namespace instep {

/// A field over a small neighbourhood of many exact points, on a surface so smooth that one
/// polynomial of the fifth degree passes through all of them: the height over it. Zero on the
/// surface, positive outside, of slope near one across it.
///
/// Where that is so, nothing is left between the points for HeightPatch to tell, which takes four
/// times the work. An immutable value; results scale with the unit.
class QuinticPatch {
 public:
  static constexpr int kDegree = 5;
  static constexpr int kTerms = (kDegree + 1) * (kDegree + 2) / 2;

  /// `outward`: unit length, out of the body. `radius` > 0: of the neighbourhood round `centre`.
  /// Nothing if the points are off the polynomial by more than 9e-5 of the radius (root mean
  /// square), do not lie on all sides of the centre, or bend it by more than 0.02 of the radius in
  /// a term of the fourth or fifth degree, as a single one may beside rows of others. O(points).
  static std::optional<QuinticPatch> fit(const std::vector<OrientedPoint>& points,
                                         const Eigen::Vector3d& centre,
                                         const Eigen::Vector3d& outward, double radius);

  FieldValue at(const Eigen::Vector3d& position) const;

  /// Of the points round the polynomial.
  double variance() const { return variance_; }

 private:
  QuinticPatch() = default;

  Eigen::Vector3d centre_;
  Eigen::Matrix3d axes_;  ///< rows: two directions on the plane, and outwards
  double radius_ = 1.0;
  /// Coefficients of x^a y^b from the highest to the lowest a, and of each from the highest to the
  /// lowest b; in unit scale.
  Eigen::Matrix<double, kTerms, 1> terms_;
  double variance_ = 0.0;
};

}  // namespace instep
