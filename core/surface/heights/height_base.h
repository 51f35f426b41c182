#pragma once

#include <Eigen/Core>

namespace instep {

/// Axes of a plane whose own directions do not matter: rows are two of these and `outward`, a unit
/// vector over it.
Eigen::Matrix3d axes_over(const Eigen::Vector3d& outward);

/// What the points of a small piece of surface are heights over: a piece of plane, or of a cylinder
/// that is bent round the body as the surface is. Over a plane the flanks of a bent piece seem
/// nearer to each other than they are, and rise without bending: what fits a surface to such
/// heights has to make up for both. Over the cylinder there is left what no cylinder has.
///
/// Unit scale: the piece has radius one. An immutable value.
class HeightBase {
 public:
  /// `axes`: rows are the direction round the body and the one along it, on the plane, and the one
  /// over it. `radius` > 0: of the piece, whose middle is `centre`.
  HeightBase(const Eigen::Matrix3d& axes, const Eigen::Vector3d& centre, double radius);

  /// Bent round the body so far that a tangent turns by `bend` (radians) from the centre to the
  /// rim, towards the inside where that is positive; by no more than 0.7, for further off the other
  /// side of the body comes near.
  HeightBase bent(double bend) const;

  /// A position as the base sees it.
  struct Spot {
    Eigen::Vector2d place;  ///< on the base: round the body and along it
    double height = 0.0;    ///< over it
    double cosine = 1.0;    ///< of the turn of the base from the centre to there
    double sine = 0.0;
    double stretch = 1.0;  ///< length at that height, against that on the base
  };
  /// Within a radius or so of the centre.
  Spot see(const Eigen::Vector3d& position) const;

  bool is_plane() const { return bend_ == 0.0; }

  /// How a surface rises over the plane where its normal is this; steep ones are flattened, as no
  /// height over the plane could follow them. Only if is_plane().
  Eigen::Vector2d slope_of(const Eigen::Vector3d& normal) const;

  /// Of the height over a surface that rises like that over the base, in the positions' own frame.
  Eigen::Vector3d gradient(const Eigen::Vector2d& slope, const Spot& spot) const;

  double radius() const { return radius_; }

 private:
  Eigen::Matrix3d axes_;
  Eigen::Vector3d centre_;
  double radius_;
  double bend_ = 0.0;
};

}  // namespace instep
