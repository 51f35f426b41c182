#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace instep {

/// A map of the platform from above: square cells, each with one value in a list of the caller's.
/// Station frame. A plain value.
struct GroundPlan {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< of least x and y
  double cell_mm = 1.0;
  int columns = 0;  ///< along x; at most 4000, as rows
  int rows = 0;

  /// One value a cell, 1 or 0.
  using Mask = std::vector<std::uint8_t>;

  /// Round all points of a cloud that is not empty, with a margin on every side.
  static GroundPlan round(const PointCloud& cloud, double cell_mm, double margin_mm);

  std::size_t cells() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row * columns + column);
  }
  int column_of(double x) const;  ///< of the nearest cell, if x lies outside
  int row_of(double y) const;
  std::size_t cell_of(const Eigen::Vector3d& point) const {
    return at(column_of(point.x()), row_of(point.y()));
  }
  Eigen::Vector2d centre(int column, int row) const {
    return corner + cell_mm * Eigen::Vector2d(column + 0.5, row + 0.5);
  }

  /// Calls `visit(cell)` for the cells whose centres lie within `radius` of a place.
  template <typename Visit>
  void disc(const Eigen::Vector2d& place, double radius, const Visit& visit) const {
    for (int row = row_of(place.y() - radius); row <= row_of(place.y() + radius); ++row) {
      for (int column = column_of(place.x() - radius); column <= column_of(place.x() + radius);
           ++column) {
        if ((centre(column, row) - place).norm() <= radius) visit(at(column, row));
      }
    }
  }

  /// All cells within `radius` of a marked one.
  Mask grown(const Mask& mask, double radius) const;

  /// All cells further than `radius` from every cell that is not marked.
  Mask shrunk(Mask mask, double radius) const;

  /// What cannot be reached from the rim of the plan without crossing the mask, the mask included.
  Mask filled(const Mask& mask) const;
};

}  // namespace instep
