#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/girth/contour/contour.h"
#include "core/girth/contour/contour_index.h"
#include "core/surface/ribbon/closed_spline_basis.h"

namespace instep {

/// A traced contour made fair: the closed curve of cubic splines nearest to it (least squares along
/// its length), which follows the section but none of its waves that are shorter than the knots are
/// apart. A place on it is told by its way: about the length along the contour from its first
/// corner. An immutable value.
class FairLine {
 public:
  /// `knots_apart` > 0. Nothing if the contour is shorter than eight times that.
  static std::optional<FairLine> through(const Contour& contour, double knots_apart);

  struct Place {
    Eigen::Vector2d point;
    Eigen::Vector2d tangent;  ///< change of the point with the way: about unit length
    Eigen::Vector2d outward;  ///< unit length
  };
  Place at(double way) const;

  /// Where a point of the plane is nearest, and how far outside of the line.
  struct Foot {
    double way = 0.0;
    double height = 0.0;
    double distance = 0.0;  ///< more than the height where the line bends away from the point
  };
  Foot foot_of(const Eigen::Vector2d& point) const;

  double length() const { return basis_.length(); }

 private:
  /// From a knot to the next: factors of rising powers of the part of the way.
  using Piece = Eigen::Matrix<double, 2, 4>;

  struct Curve {
    Eigen::Vector2d point;
    Eigen::Vector2d tangent;
    Eigen::Vector2d bend;  ///< change of the tangent with the way
  };

  FairLine(const ClosedSplineBasis& basis, const Eigen::MatrixX2d& terms);

  static std::vector<Piece> pieces_of(const ClosedSplineBasis& basis,
                                      const Eigen::MatrixX2d& terms);
  std::vector<Eigen::Vector2d> corners_on_it() const;
  Curve curve_at(double way) const;

  ClosedSplineBasis basis_;
  std::vector<Piece> pieces_;
  ContourIndex corners_;  ///< of some places on the curve, equally many from knot to knot
};

}  // namespace instep
