#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace instep {

/// Finds the nearest of some hundred places, or fewer, on a plane: a grid of square cells over and
/// round them, each with the places that can be the nearest to a point in it. Made for many more
/// points than places. An immutable value.
class CornerGrid {
 public:
  /// At least one corner. O(600 x corners).
  explicit CornerGrid(std::vector<Eigen::Vector2d> corners);

  /// Its number; the first of those that are as near. Beyond the grid, which reaches a sixth of the
  /// corners' extent beyond them, it looks at all.
  std::size_t nearest(const Eigen::Vector2d& point) const;

 private:
  void add_cell(const Eigen::Vector2d& middle);

  std::vector<Eigen::Vector2d> corners_;
  Eigen::Vector2d origin_;
  double side_ = 1.0;
  std::vector<std::uint32_t> begins_;   ///< of each cell in members_, and the end of the last
  std::vector<std::uint32_t> members_;  ///< corners, cell by cell
};

}  // namespace instep
