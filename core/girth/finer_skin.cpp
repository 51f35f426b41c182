#include "core/girth/finer_skin.h"

#include <algorithm>
#include <cmath>

namespace instep {
namespace {

constexpr std::size_t kCellsFromKnot = 6;
constexpr std::size_t kCellsAcross = 5;
/// Fewer do not tell how they scatter within a cell.
constexpr double kFewestInCell = 1.5;
/// In standard deviations of what the means would differ by.
constexpr double kSure = 4.0;
/// Of points: beyond this they may be strays.
constexpr double kFarOff = 2.5;

struct Cell {
  double sum = 0.0;  ///< of heights over the spline, each times its certainty
  double certainty = 0.0;
};

/// Over cells: of their own means, and of their points within them.
struct Scatter {
  double between = 0.0;  ///< squares
  double within = 0.0;
  double cells = 0.0;  ///< with points
  double points = 0.0;
};

std::size_t part_of(double share, std::size_t parts) {
  const double part = std::clamp(share, 0.0, 1.0) * static_cast<double>(parts);
  return std::min(static_cast<std::size_t>(part), parts - 1);
}

Scatter scatter_of(const std::vector<RibbonPoint>& points, const RibbonSpline& spline,
                   double length, std::size_t rows) {
  std::vector<Cell> cells(rows * kCellsAcross);
  Scatter scatter;
  const double farthest = std::pow(kFarOff * spline.sigma(), 2);
  for (const auto& point : points) {
    const double off = point.height - spline.at(point.way, point.off).value;
    const double squared = point.certainty * off * off;
    if (!(point.certainty > 0.0) || squared > farthest) continue;
    const double round = point.way / length;
    const std::size_t row = part_of(round - std::floor(round), rows);
    Cell& cell = cells[row * kCellsAcross + part_of(0.5 * (1.0 + point.off), kCellsAcross)];
    cell.sum += point.certainty * off;
    cell.certainty += point.certainty;
    scatter.within += squared;
    scatter.points += 1.0;
  }
  for (const auto& cell : cells) {
    if (!(cell.certainty > 0.0)) continue;
    scatter.between += cell.sum * cell.sum / cell.certainty;
    scatter.cells += 1.0;
  }
  scatter.within -= scatter.between;
  return scatter;
}

}  // namespace

bool shows_finer_skin(const std::vector<RibbonPoint>& points, const RibbonSpline& spline,
                      double length, std::size_t knots) {
  const Scatter scatter = scatter_of(points, spline, length, kCellsFromKnot * knots);
  if (!(scatter.points > kFewestInCell * scatter.cells)) return false;
  const double others = scatter.points - scatter.cells;
  const double noise = scatter.within / others;
  const double more = scatter.between / noise - scatter.cells;
  return more > kSure * std::sqrt(2.0 * scatter.cells * scatter.points / others);
}

}  // namespace instep
