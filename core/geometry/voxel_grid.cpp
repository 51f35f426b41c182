#include "core/geometry/voxel_grid.h"

#include <algorithm>

#include "core/geometry/disjoint_sets.h"

namespace instep {
namespace {

constexpr std::int64_t kHalf = 1 << 20;  // 21 bits an axis

std::uint64_t axis_number(double coordinate, double cell_mm) {
  const double cell = std::clamp(coordinate / cell_mm, static_cast<double>(2 - kHalf),
                                 static_cast<double>(kHalf - 2));
  const auto towards_zero = static_cast<std::int64_t>(cell);
  const std::int64_t number =
      static_cast<double>(towards_zero) > cell ? towards_zero - 1 : towards_zero;
  return static_cast<std::uint64_t>(number + kHalf);
}

using KeyOfPoint = std::pair<std::uint64_t, std::uint32_t>;

/// Points often come in the order of x: then those of each layer of cells follow each other, and
/// are put in order by themselves.
void sort_by_keys(std::vector<KeyOfPoint>& keys) {
  constexpr int kBitsOfLayer = 42;  // y and z
  const auto layer = [](const KeyOfPoint& key) { return key.first >> kBitsOfLayer; };
  const auto in_lower_layer = [&](const auto& a, const auto& b) { return layer(a) < layer(b); };
  if (!std::is_sorted(keys.begin(), keys.end(), in_lower_layer)) {
    return std::sort(keys.begin(), keys.end());
  }
  for (auto begin = keys.begin(); begin != keys.end();) {
    const auto end = std::find_if(begin, keys.end(),
                                  [&](const auto& key) { return layer(key) != layer(*begin); });
    std::sort(begin, end);
    begin = end;
  }
}

}  // namespace

/// z counts in the lowest bits, so that cells above each other follow each other.
std::uint64_t VoxelGrid::key_of(const Eigen::Vector3d& point, double cell_mm) {
  constexpr auto kStep = static_cast<std::uint64_t>(kSpan);
  return (axis_number(point.x(), cell_mm) * kStep + axis_number(point.y(), cell_mm)) * kStep +
         axis_number(point.z(), cell_mm);
}

VoxelGrid::VoxelGrid(const std::vector<Eigen::Vector3d>& points, double cell_mm) {
  std::vector<KeyOfPoint> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    order[i] = {key_of(points[i], cell_mm), static_cast<std::uint32_t>(i)};
  }
  sort_by_keys(order);
  members_.reserve(order.size());
  for (const auto& [key, index] : order) {
    if (keys_.empty() || keys_.back() != key) {
      keys_.push_back(key);
      begins_.push_back(static_cast<std::uint32_t>(members_.size()));
    }
    members_.push_back(index);
  }
  begins_.push_back(static_cast<std::uint32_t>(members_.size()));
  find_rows();
}

/// The cells above each other round a cell follow each other in the order of keys: nine rows, whose
/// beginnings move forward as the cell does.
void VoxelGrid::find_rows() {
  rows_.resize(cell_count());
  for (std::size_t row = 0; row < kRows; ++row) {
    const std::uint64_t shift = row_shift(row);
    std::size_t at = 0;
    for (std::size_t cell = 0; cell < cell_count(); ++cell) {
      while (at < cell_count() && keys_[at] < keys_[cell] + shift) ++at;
      rows_[cell][row] = static_cast<std::uint32_t>(at);
    }
  }
}

std::vector<std::size_t> VoxelGrid::face_neighbourhood(std::size_t cell) const {
  constexpr std::size_t kOwnRow = 4;
  std::vector<std::size_t> found;
  for (const std::size_t row : {1U, 3U, 4U, 5U, 7U}) {
    const std::uint64_t level = keys_[cell] + row_shift(row) + 1;
    const std::uint64_t reach = row == kOwnRow ? 1 : 0;
    for (std::size_t at = rows_[cell][row]; at < cell_count() && keys_[at] <= level + reach; ++at) {
      if (keys_[at] + reach >= level) found.push_back(at);
    }
  }
  return found;
}

std::vector<std::size_t> VoxelGrid::clusters() const {
  DisjointSets joined(cell_count());
  for (std::size_t cell = 0; cell < cell_count(); ++cell) {
    each_near(cell, [&](std::size_t other) {
      if (other < cell) joined.join(cell, other);
    });
  }
  return joined.numbers();
}

std::vector<std::size_t> VoxelGrid::clusters_of_points() const {
  const auto of_cell = clusters();
  std::vector<std::size_t> of_point(members_.size());
  for (std::size_t cell = 0; cell < cell_count(); ++cell) {
    for (const std::uint32_t index : members(cell)) of_point[index] = of_cell[cell];
  }
  return of_point;
}

}  // namespace instep
