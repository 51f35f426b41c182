#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace instep {

/// Points sorted into cubic cells: who shares a cell, which cells touch. Finds crowds and clusters
/// far quicker than a search tree, where the answer need not be finer than a cell.
///
/// Only occupied cells are kept, in a fixed order that depends on the points alone. Coordinates
/// must be finite; those beyond a million cells from the origin are put into the outermost cell.
/// Building costs one sort. Read-only afterwards.
class VoxelGrid {
 public:
  /// `cell_mm` > 0.
  VoxelGrid(const std::vector<Eigen::Vector3d>& points, double cell_mm);

  std::size_t cell_count() const { return keys_.size(); }

  /// Indices of the points in a cell, ascending.
  std::span<const std::uint32_t> members(std::size_t cell) const {
    return {members_.data() + begins_[cell], members_.data() + begins_[cell + 1]};
  }

  /// Calls with each occupied cell among a cell and the 26 round it, the cell itself included,
  /// ascending.
  template <typename Visit>
  void each_near(std::size_t cell, const Visit& visit) const {
    for (std::size_t row = 0; row < kRows; ++row) {
      const std::uint64_t lowest = keys_[cell] + row_shift(row);
      for (std::size_t at = rows_[cell][row]; at < cell_count() && keys_[at] <= lowest + 2; ++at)
        visit(at);
    }
  }

  /// The occupied cells among a cell and the six that share a face with it, the cell itself
  /// included, ascending.
  std::vector<std::size_t> face_neighbourhood(std::size_t cell) const;

  /// For each cell the number of its cluster: cells that touch, by face, edge or corner, are of
  /// one cluster. Clusters are numbered from zero by their first cell.
  std::vector<std::size_t> clusters() const;

  /// The same for each point.
  std::vector<std::size_t> clusters_of_points() const;

 private:
  static constexpr std::size_t kRows = 9;
  static constexpr std::int64_t kSpan = 1 << 21;  // of the cells on an axis

  /// What to add to a key for the lowest cell of the row-th of the nine rows round it.
  static std::uint64_t row_shift(std::size_t row) {
    const auto number = static_cast<std::int64_t>(row);
    return static_cast<std::uint64_t>(((number / 3 - 1) * kSpan + number % 3 - 1) * kSpan - 1);
  }

  static std::uint64_t key_of(const Eigen::Vector3d& point, double cell_mm);
  void find_rows();

  std::vector<std::uint64_t> keys_;     ///< of occupied cells, ascending
  std::vector<std::uint32_t> begins_;   ///< first member of each cell, and the end of the last
  std::vector<std::uint32_t> members_;  ///< point indices, cell by cell
  std::vector<std::array<std::uint32_t, kRows>> rows_;  ///< first cell not before each row
};

}  // namespace instep
