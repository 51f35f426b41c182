#include "core/girth/corner_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace instep {
namespace {

/// Across the corners, and beyond them to each side.
constexpr int kCellsAcross = 18;
constexpr int kCellsBeside = 3;
constexpr int kCells = kCellsAcross + 2 * kCellsBeside;

}  // namespace

CornerGrid::CornerGrid(std::vector<Eigen::Vector2d> corners)
    : corners_(std::move(corners)), begins_{0} {
  Eigen::AlignedBox2d box;
  for (const auto& corner : corners_) box.extend(corner);
  side_ = std::max(box.sizes().maxCoeff() / kCellsAcross, std::numeric_limits<double>::min());
  origin_ = box.center() - Eigen::Vector2d::Constant(0.5 * kCells * side_);
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      add_cell(origin_ + side_ * Eigen::Vector2d(column + 0.5, row + 0.5));
    }
  }
}

void CornerGrid::add_cell(const Eigen::Vector2d& middle) {
  std::vector<double> squared;
  squared.reserve(corners_.size());
  for (const auto& corner : corners_) squared.push_back((corner - middle).squaredNorm());
  const double least = *std::min_element(squared.begin(), squared.end());
  // No point of the cell is further from the middle than half of the diagonal.
  const double most = std::sqrt(least) + std::numbers::sqrt2 * side_;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    if (squared[i] <= most * most) members_.push_back(static_cast<std::uint32_t>(i));
  }
  begins_.push_back(static_cast<std::uint32_t>(members_.size()));
}

std::size_t CornerGrid::nearest(const Eigen::Vector2d& point) const {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](std::size_t corner) {
    const double squared = (corners_[corner] - point).squaredNorm();
    if (!(squared < least)) return;
    least = squared;
    nearest = corner;
  };
  const Eigen::Array2d place = (point - origin_).array() / side_;
  if ((place >= 0.0).all() && (place < kCells).all()) {
    const Eigen::Array2i cell = place.cast<int>();
    const auto number = static_cast<std::size_t>(cell.y() * kCells + cell.x());
    for (auto at = begins_[number]; at < begins_[number + 1]; ++at) look_at(members_[at]);
  } else {
    for (std::size_t corner = 0; corner < corners_.size(); ++corner) look_at(corner);
  }
  return nearest;
}

}  // namespace instep
