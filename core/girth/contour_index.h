#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/girth/contour_trace.h"

namespace instep {

/// Finds where on a traced contour a point of the plane is nearest. The contour's corners lie close
/// and evenly, as trace_contour() puts them; at least one. Keeps what it needs of the contour.
class ContourIndex {
 public:
  explicit ContourIndex(const Contour& contour);

  struct Foot {
    double distance = 0.0;
    double way = 0.0;  ///< along the corners, from the first one
  };
  Foot foot_of(const Eigen::Vector2d& point) const;

  /// Of the polygon through the corners.
  double length() const { return ways_.back(); }

 private:
  PointIndex corners_;
  std::vector<double> ways_;  ///< to each corner, and to the first one again
};

}  // namespace instep
