#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/surface/oriented_point.h"

namespace instep {

/// A field over a small neighbourhood that is near zero on its points and grows at unit rate along
/// their normals: the paper's eq. 6 with the normals as Hermite data instead of points put off the
/// surface, so that no offset has to be chosen (Macedo, Gois, Velho 2011). The polynomial is the
/// quadratic one that r^3 leaves unpenalised in space: curvature is no roughness. It knows both
/// sides of a thin part, such as the rim of a sole, which heights over one plane cannot; where they
/// can, HeightPatch is quicker and smooths better.
///
/// Read as kriging: the field wanders with variogram roughness * r^3, each value carries its
/// point's variance, and that ratio is the smoothing. Coordinates are centred and scaled within, so
/// that results scale with the unit. The system is solved on the null space of the polynomial
/// block, where it is positive definite, by Cholesky.
class HermitePatch {
 public:
  /// Coefficients of 1, x, y, z, xx, yy, zz, xy, yz, zx.
  using Polynomial = Eigen::Matrix<double, 10, 1>;

  /// Nothing if the points do not determine a field (all equal); points on one line
  /// determine it along their normals only. `radius` > 0 is the size of the neighbourhood round
  /// `centre`. O((2 points)^3).
  static std::optional<HermitePatch> fit(const std::vector<OrientedPoint>& points,
                                         const Eigen::Vector3d& centre, double radius,
                                         double roughness);

  FieldValue at(const Eigen::Vector3d& position) const;

 private:
  HermitePatch() = default;

  Eigen::Vector3d centre_;
  double radius_ = 1.0;
  Eigen::Matrix3Xd positions_;  ///< centred and scaled
  Eigen::Matrix3Xd normals_;
  Eigen::VectorXd value_weights_;
  Eigen::VectorXd slope_weights_;
  Polynomial polynomial_;
};

}  // namespace instep
