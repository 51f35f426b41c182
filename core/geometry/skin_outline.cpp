#include "core/geometry/skin_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "core/geometry/plane_vectors.h"
#include "core/geometry/voxel_grid.h"
#include "core/median.h"

namespace instep {
namespace {

constexpr std::size_t kDirections = 64;
constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr double kSparser = 0.3;
/// Of the usual reach; where no skin is strays may reach further.
constexpr double kFurthest = 2.0;
constexpr int kRounds = 3;
/// Of a cell, against what half of them hold.
constexpr std::size_t kMostOfCell = 10;
/// Points that show the outline.
constexpr std::size_t kEnough = 2000;

/// How far points are from a middle, by direction.
using Reaches = std::array<std::vector<double>, kDirections>;

Reaches reaches_round(const Eigen::Vector2d& middle, const std::vector<Eigen::Vector3d>& points) {
  Reaches reaches;
  for (const auto& point : points) {
    const Eigen::Vector2d arm = point.head<2>() - middle;
    reaches[sector_of(arm, kDirections)].push_back(arm.norm());
  }
  return reaches;
}

/// The middle one of all cells, each by its first point.
Eigen::Vector2d middle_of_cells(const VoxelGrid& grid, const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const Eigen::Vector3d& point = points[grid.members(cell).front()];
    x.push_back(point.x());
    y.push_back(point.y());
  }
  return {median(std::move(x)), median(std::move(y))};
}

/// Some of the points, not many of one cell.
std::vector<Eigen::Vector3d> some_of_each_cell(const VoxelGrid& grid,
                                               const std::vector<Eigen::Vector3d>& points) {
  std::vector<std::size_t> counts;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    counts.push_back(grid.members(cell).size());
  }
  const std::size_t most = kMostOfCell * median(std::move(counts));
  std::vector<Eigen::Vector3d> some;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const auto members = grid.members(cell);
    for (const auto member : members.first(std::min(most, members.size()))) {
      some.push_back(points[member]);
    }
  }
  const std::size_t stride = 1 + some.size() / kEnough;
  for (std::size_t i = 0; i * stride < some.size(); ++i) some[i] = some[i * stride];
  some.resize((some.size() + stride - 1) / stride);
  return some;
}

/// The middle one of each direction; 0 of those without points.
std::array<double, kDirections> medians_of(const Reaches& reaches) {
  std::array<double, kDirections> medians;
  std::vector<double> known;
  for (std::size_t i = 0; i < kDirections; ++i) {
    medians[i] = median(reaches[i]);
    if (medians[i] > 0.0) known.push_back(medians[i]);
  }
  const double furthest = kFurthest * median(std::move(known));
  for (double& reach : medians) reach = std::min(reach, furthest);
  return medians;
}

Eigen::Vector2d heading_of(std::size_t direction) {
  const double angle = kFullTurn * ((static_cast<double>(direction) + 0.5) / kDirections - 0.5);
  return {std::cos(angle), std::sin(angle)};
}

/// The centre of gravity of what the medians enclose, in sectors of a circle.
Eigen::Vector2d middle_of_outline(const Eigen::Vector2d& inside,
                                  const std::vector<Eigen::Vector3d>& points) {
  const auto reaches = medians_of(reaches_round(inside, points));
  Eigen::Vector2d moments = Eigen::Vector2d::Zero();
  double area = 0.0;
  for (std::size_t i = 0; i < kDirections; ++i) {
    moments += std::pow(reaches[i], 3) / 3.0 * heading_of(i);
    area += std::pow(reaches[i], 2) / 2.0;
  }
  return area > 0.0 ? Eigen::Vector2d(inside + moments / area) : inside;
}

}  // namespace

SkinOutline outline_of_skin(const std::vector<Eigen::Vector3d>& points, double height,
                            double side) {
  SkinOutline outline;
  if (points.empty()) return outline;
  const VoxelGrid grid(points, side);
  const auto some = some_of_each_cell(grid, points);
  outline.middle = middle_of_cells(grid, points);
  for (int i = 0; i < kRounds; ++i) outline.middle = middle_of_outline(outline.middle, some);
  const auto reaches = reaches_round(outline.middle, points);
  const auto medians = medians_of(reaches);
  std::vector<double> densities;
  for (std::size_t i = 0; i < kDirections; ++i) {
    if (!(medians[i] > 0.0)) continue;
    outline.places.emplace_back(outline.middle + medians[i] * heading_of(i));
    const double area = kFullTurn / kDirections * medians[i] * height;
    densities.push_back(static_cast<double>(reaches[i].size()) / area);
  }
  outline.density = quantile(std::move(densities), kSparser);
  return outline;
}

}  // namespace instep
