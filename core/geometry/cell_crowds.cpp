#include "core/geometry/cell_crowds.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "core/median.h"

namespace instep {
namespace {

using Cell = Eigen::Array<std::int64_t, 3, 1>;

/// A point of one layer of cells, which all have the same first number.
struct Member {
  std::int64_t row;
  std::int64_t level;
  double off;  ///< square of how far it is from the cell's middle, in sides
  std::size_t point;

  bool shares_cell_with(const Member& other) const {
    return row == other.row && level == other.level;
  }
  bool operator<(const Member& other) const {
    return std::tie(row, level, off, point) <
           std::tie(other.row, other.level, other.off, other.point);
  }
};

/// Times what three quarters of the cells hold at most.
constexpr std::size_t kManyTimes = 8;
constexpr double kUsual = 0.75;

}  // namespace

bool CellCrowds::has_pile() const {
  const std::size_t most = kManyTimes * quantile(counts, kUsual);
  return std::any_of(counts.begin(), counts.end(), [&](std::size_t count) { return count > most; });
}

CellCrowds crowds_in_cells(const std::vector<Eigen::Vector3d>& points, double side) {
  CellCrowds crowds{std::vector<bool>(points.size(), false), {}};
  if (points.empty()) return crowds;
  Eigen::Array3d least = points.front();
  for (const auto& point : points) least = least.min(point.array());
  std::vector<Member> layer;
  std::int64_t column = 0;
  const auto mark_layer = [&] {
    std::sort(layer.begin(), layer.end());
    for (std::size_t i = 0; i < layer.size(); ++i) {
      const bool crowding = i > 0 && layer[i].shares_cell_with(layer[i - 1]);
      crowds.crowding[layer[i].point] = crowding;
      if (!crowding) crowds.counts.push_back(0);
      ++crowds.counts.back();
    }
    layer.clear();
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Array3d place = (points[i].array() - least) / side;
    const Cell cell = place.cast<std::int64_t>();
    if (cell.x() != column) mark_layer();
    column = cell.x();
    const double off = (place - cell.cast<double>() - 0.5).square().sum();
    layer.push_back({cell.y(), cell.z(), off, i});
  }
  mark_layer();
  return crowds;
}

}  // namespace instep
