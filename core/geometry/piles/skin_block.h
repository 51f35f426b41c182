#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/quadratic_skin.h"
#include "core/geometry/voxel_grid.h"

namespace instep {

/// A cell of a grid and the 26 round it: as large a piece of skin as its middle can be told from.
/// Borrows the grid. Building one costs no look at its points.
class CellBlock {
 public:
  CellBlock(const VoxelGrid& grid, std::size_t cell);

  /// Of the cell.
  std::span<const std::uint32_t> members() const { return grid_.members(cell_); }

  /// Points of all cells, and of the fullest.
  std::size_t size() const { return size_; }
  std::size_t fullest() const { return fullest_; }

  /// A cell of less than half the points of the fullest one: where the skin only passes beside it,
  /// or ends.
  bool is_fringe() const { return 2 * members().size() < fullest_; }

  /// Calls with each point of all cells.
  template <typename Visit>
  void each(const Visit& visit) const {
    grid_.each_near(cell_, [&](std::size_t near) {
      for (const auto member : grid_.members(near)) visit(member);
    });
  }

  /// Of these 2,000 to 4,000, evenly over their order, or all if they are fewer.
  std::vector<std::uint32_t> sample() const;

 private:
  const VoxelGrid& grid_;
  std::size_t cell_;
  std::size_t size_ = 0;
  std::size_t fullest_ = 0;
};

/// Where the skin of a block lies: seen in sides of a cell, from the middle of its points, x and y
/// along the skin and z over it.
class BlockView {
 public:
  /// `side` > 0 of the grid's cells.
  BlockView(const std::vector<Eigen::Vector3d>& points, const CellBlock& block, double side);

  /// Whether the points lie like a piece of skin, not like a heap.
  bool is_flat() const { return is_flat_; }
  Eigen::Vector3d normal() const { return axes_.col(2); }
  Eigen::Vector3d of(const Eigen::Vector3d& point) const {
    return axes_.transpose() * ((point - origin_) / side_ - middle_);
  }

 private:
  Eigen::Vector3d origin_;
  double side_;
  Eigen::Vector3d middle_;
  Eigen::Matrix3d axes_;
  bool is_flat_;
};

/// The skin of a block: a quadratic through its points.
class BlockSkin {
 public:
  /// Nothing where the points are too few, or so near to each other or to a line that they show
  /// none.
  static std::optional<BlockSkin> through(const std::vector<Eigen::Vector3d>& points,
                                          const CellBlock& block, const BlockView& view);

  /// Of a point that the view sees there, in sides.
  double distance(const Eigen::Vector3d& seen) const {
    return std::abs(seen.z() - skin_.at(seen.x(), seen.y()));
  }

  /// Standard deviation of the points round it, in sides, by the median.
  double scatter() const { return scatter_; }

  /// That of the skin itself at the cell, of noise that is no more than that.
  double error() const;

 private:
  explicit BlockSkin(const QuadraticSkin& skin) : skin_(skin) {}

  QuadraticSkin skin_;
  double points_ = 0.0;
  double scatter_ = 0.0;
};

}  // namespace instep
