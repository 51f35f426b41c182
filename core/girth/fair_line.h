#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/girth/contour_index.h"
#include "core/girth/contour_trace.h"
#include "core/surface/closed_spline_basis.h"

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
  FairLine(const Contour& contour, Eigen::Index knots);

  ContourIndex corners_;
  ClosedSplineBasis basis_;
  Eigen::MatrixX2d terms_;
};

}  // namespace instep
