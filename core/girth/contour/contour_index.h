#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/girth/contour/contour.h"

namespace instep {

/// Finds where on a closed polygon a point of the plane is nearest: on a traced contour, or of any
/// corners that lie about evenly along it; at least one. Keeps what it needs of them. Near the
/// polygon a query looks at a few corners only, far from it at more and more of them.
class ContourIndex {
 public:
  explicit ContourIndex(std::vector<Eigen::Vector2d> corners);
  explicit ContourIndex(const Contour& contour) : ContourIndex(contour.points) {}

  /// The number of the corner nearest to a finite point; the first of those that are as near.
  std::size_t nearest_corner(const Eigen::Vector2d& point) const;

  struct Foot {
    double distance = 0.0;
    double way = 0.0;  ///< along the corners, from the first one
  };
  Foot foot_of(const Eigen::Vector2d& point) const;

  /// Whether the foot of a point is at most so far from it. Quicker than the foot, where a corner
  /// beside the point is near enough.
  bool passes_within(double distance, const Eigen::Vector2d& point) const;

  /// Of the polygon through the corners.
  double length() const { return ways_.back(); }

 private:
  /// Of a square cell: from 0 to below cells_, in both directions.
  using Cell = Eigen::Array2i;

  std::size_t number_of(int column, int row) const;
  Cell cell_of(const Eigen::Vector2d& point) const;

  std::vector<Eigen::Vector2d> corners_;
  std::vector<double> ways_;  ///< to each corner, and to the first one again
  Eigen::Vector2d origin_;    ///< of the cells
  int cells_;                 ///< across the contour
  double side_ = 1.0;
  std::vector<std::uint32_t> begins_;   ///< of each cell in members_, and the end of the last
  std::vector<std::uint32_t> members_;  ///< corners, cell by cell
};

}  // namespace instep
