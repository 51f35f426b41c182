#include "core/fusion/sole/ground_plan.h"

#include <algorithm>
#include <utility>

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr int kMostCells = 4000;  // a side; a foot needs some 200

GroundPlan::Mask inverted(GroundPlan::Mask mask) {
  for (auto& cell : mask) cell = cell ? 0 : 1;
  return mask;
}

}  // namespace

GroundPlan GroundPlan::round(const PointCloud& cloud, double cell_mm, double margin_mm) {
  Vector2d least = cloud.positions.front().head<2>();
  Vector2d most = least;
  for (const auto& point : cloud.positions) {
    least = least.cwiseMin(point.head<2>());
    most = most.cwiseMax(point.head<2>());
  }
  GroundPlan plan;
  plan.cell_mm = cell_mm;
  plan.corner = least.array() - margin_mm;
  const Vector2d size = (most - least).array() + 2 * margin_mm;
  plan.columns = std::min(kMostCells, static_cast<int>(size.x() / cell_mm) + 2);
  plan.rows = std::min(kMostCells, static_cast<int>(size.y() / cell_mm) + 2);
  return plan;
}

int GroundPlan::column_of(double x) const {
  return std::clamp(static_cast<int>((x - corner.x()) / cell_mm), 0, columns - 1);
}

int GroundPlan::row_of(double y) const {
  return std::clamp(static_cast<int>((y - corner.y()) / cell_mm), 0, rows - 1);
}

GroundPlan::Mask GroundPlan::grown(const Mask& mask, double radius) const {
  Mask larger(mask.size(), 0);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (!mask[at(column, row)]) continue;
      disc(centre(column, row), radius, [&](std::size_t cell) { larger[cell] = 1; });
    }
  }
  return larger;
}

GroundPlan::Mask GroundPlan::shrunk(Mask mask, double radius) const {
  return inverted(grown(inverted(std::move(mask)), radius));
}

GroundPlan::Mask GroundPlan::filled(const Mask& mask) const {
  Mask inside(mask.size(), 1);
  std::vector<std::pair<int, int>> open = {{0, 0}};
  inside[0] = 0;
  while (!open.empty()) {
    const auto [column, row] = open.back();
    open.pop_back();
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int x = column + dx;
      const int y = row + dy;
      if (x < 0 || y < 0 || x >= columns || y >= rows) continue;
      if (mask[at(x, y)] || !inside[at(x, y)]) continue;
      inside[at(x, y)] = 0;
      open.emplace_back(x, y);
    }
  }
  return inside;
}

}  // namespace instep
