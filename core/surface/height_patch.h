#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/surface/height_samples.h"
#include "core/surface/oriented_point.h"

namespace instep {

/// A field over a small neighbourhood: the height over the piece of surface that its points make.
/// Zero on the surface, positive outside, of slope near one across it.
///
/// The surface is the paper's radial basis functions (eqs. 6 and 7, phi = r^3, a smoothing for each
/// point) with a quadratic polynomial (a plane for fewer than nine points), over the tangent plane:
/// as heights, points need no others put off the surface (eq. 5) and no normals but for the side,
/// and the system is half as large. It is solved on the null space of the polynomial block, where
/// it is positive definite, by Cholesky, centred and in unit scale.
///
/// Read as kriging: once a quadratic is taken out, heights wander with variogram
/// roughness * distance^3. The roughness is the likeliest one (restricted maximum likelihood) given
/// the points and a prior; a point's smoothing is its variance against four times that, since a
/// length is asked for in the end, over which noise averages out but flattened bends add up.
class HeightPatch {
 public:
  /// `outward`: unit length, out of the body, within some 60 degrees of all normals. `radius` > 0:
  /// of the neighbourhood round `centre`. `roughness` > 0: likely value, to within a factor of ten
  /// or so. Points beyond 60 are averaged over cells. Nothing if the points do not determine a
  /// surface (fewer than four, all on one line). O(min(points, 64)^3 + points).
  static std::optional<HeightPatch> fit(const std::vector<OrientedPoint>& points,
                                        const Eigen::Vector3d& centre,
                                        const Eigen::Vector3d& outward, double radius,
                                        double roughness);

  FieldValue at(const Eigen::Vector3d& position) const;

  /// The likeliest; for exact points the given one.
  double roughness() const { return roughness_; }

  /// Twice the negative log likelihood of the points, for comparing models of the same points.
  double misfit() const { return misfit_; }

 private:
  HeightPatch() = default;

  Eigen::Vector3d centre_;
  Eigen::Matrix3d axes_;  ///< rows: two directions on the plane, and outwards
  double radius_ = 1.0;
  Eigen::Matrix2Xd places_;
  Eigen::VectorXd weights_;
  Quadratic polynomial_;
  double roughness_ = 0.0;
  double misfit_ = 0.0;
};

}  // namespace instep
