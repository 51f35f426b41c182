#include "daemon/page/foot_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLeastCellMm = 2.2;
constexpr double kMostCells = 250.0;  ///< along the longer edge
constexpr double kPointsPerCell = 3.0;
constexpr double kCutMm = 6.0;
/// Of the cell's edge.
constexpr std::array kReliefRadius = {0.0, 0.14, 0.21, 0.28, 0.35, 0.42};
constexpr double kContrast = 1.2;
constexpr double kNowhere = -std::numeric_limits<double>::infinity();
constexpr double kHiddenBehindMm = 12.0;
/// Coordinates beyond this are no foot's.
constexpr double kFarthestMm = 1000.0;

/// Whether a convex polygon, counter-clockwise, holds a point.
bool holds(const std::vector<Vector2d>& polygon, const Vector2d& point) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Vector2d offset = point - polygon[i];
    if (edge.x() * offset.y() < edge.y() * offset.x()) return false;
  }
  return true;
}

}  // namespace

FootView::FootView(const FootScan& foot, From from, double highest_mm) {
  const double heading = -foot.medial_sign();  // of the toes: +1 to the right
  right_ = heading * Vector3d::UnitX();
  if (from == From::kAbove) {
    down_ = -heading * Vector3d::UnitY();
    towards_ = Vector3d::UnitZ();
  } else {
    down_ = -Vector3d::UnitZ();
    towards_ = foot.medial_sign() * Vector3d::UnitY();
  }
  std::vector<Vector3d> points;
  for (const auto& point : foot.cloud.positions) {
    const bool is_near = point.allFinite() && point.cwiseAbs().maxCoeff() < kFarthestMm;
    if (is_near && point.z() <= highest_mm) points.push_back(point);
  }
  for (const auto& point : points) bounds_.extend(seen(point));
  keep_nearest(points);
  if (from == From::kAbove) cap_the_cut(foot, highest_mm);
}

void FootView::place(const Vector2d& corner, double units_per_mm) {
  corner_ = corner;
  units_per_mm_ = units_per_mm;
}

Vector2d FootView::seen(const Vector3d& point) const {
  return {right_.dot(point), down_.dot(point)};
}

Vector2d FootView::operator()(const Vector3d& point) const {
  const Vector2d origin = bounds_.isEmpty() ? Vector2d(Vector2d::Zero()) : Vector2d(bounds_.min());
  return corner_ + units_per_mm_ * (seen(point) - origin);
}

GridCell FootView::cell_of(const Vector3d& point) const {
  const Vector2d place = (seen(point) - bounds_.min()) / cell_mm_;
  return {static_cast<int>(std::floor(place.y())), static_cast<int>(std::floor(place.x()))};
}

/// What lies behind is hidden: a cell keeps the point that is nearest to who looks.
void FootView::keep_nearest(const std::vector<Vector3d>& points) {
  if (points.empty()) return;
  const Vector2d extent = bounds_.sizes();
  const double apart =
      std::sqrt(extent.prod() * kPointsPerCell / static_cast<double>(points.size()));
  cell_mm_ = std::max(
      {kLeastCellMm, std::min(apart, extent.maxCoeff() / 20.0), extent.maxCoeff() / kMostCells});
  const GridCell last = {static_cast<int>(extent.y() / cell_mm_),
                         static_cast<int>(extent.x() / cell_mm_)};
  rows_ = last.first + 1;
  columns_ = last.second + 1;
  nearest_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_), kNowhere);
  for (const auto& point : points) {
    double& nearest = nearness(cell_of(point));
    nearest = std::max(nearest, towards_.dot(point));
  }
}

double& FootView::nearness(const GridCell& cell) {
  // A point on the far edge may be rounded over it.
  const auto row = static_cast<std::size_t>(std::clamp(cell.first, 0, rows_ - 1));
  const auto column = static_cast<std::size_t>(std::clamp(cell.second, 0, columns_ - 1));
  return nearest_[row * static_cast<std::size_t>(columns_) + column];
}

double FootView::nearness(const GridCell& cell) const {
  const auto [row, column] = cell;
  if (row < 0 || row >= rows_ || column < 0 || column >= columns_) return kNowhere;
  return nearest_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
}

std::vector<GridCell> FootView::body() const {
  std::vector<GridCell> cells;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      if (nearness({row, column}) > kNowhere) cells.emplace_back(row, column);
    }
  }
  return cells;
}

void FootView::cap_the_cut(const FootScan& foot, double highest_mm) {
  std::vector<Vector2d> rim;
  bool goes_on = false;
  for (const auto& point : foot.cloud.positions) {
    if (!point.allFinite()) continue;
    goes_on = goes_on || point.z() > highest_mm;
    if (std::abs(point.z() - highest_mm + kCutMm) < kCutMm) rim.push_back(seen(point));
  }
  if (!goes_on || rim.size() < 3) return;
  const auto cut = convex_hull(rim);
  if (cut.size() < 3) return;
  Eigen::AlignedBox2d box;
  for (const auto& corner : cut) box.extend(Vector2d((corner - bounds_.min()) / cell_mm_));
  for (int row = static_cast<int>(box.min().y()); row <= static_cast<int>(box.max().y()); ++row) {
    for (int column = static_cast<int>(box.min().x()); column <= static_cast<int>(box.max().x());
         ++column) {
      const Vector2d middle = bounds_.min() + cell_mm_ * Vector2d(column + 0.5, row + 0.5);
      if (holds(cut, middle)) nearness({row, column}) = highest_mm;
    }
  }
}

bool FootView::hides(const Vector3d& point) const {
  if (is_empty() || !bounds_.contains(seen(point))) return false;
  return nearness(cell_of(point)) > towards_.dot(point) + kHiddenBehindMm;
}

Vector2d FootView::centre(const GridCell& cell) const {
  return corner_ + units_per_mm_ * cell_mm_ * Vector2d(cell.second + 0.5, cell.first + 0.5);
}

/// 0 to 1, from the slope to the neighbours; 0 at the rim, where they are not known.
double FootView::darkness(const GridCell& cell) const {
  const Vector3d light = Vector3d(-0.5, -0.6, 0.75).normalized();  // right, down, towards
  const auto slope = [&](int rows, int columns) -> std::optional<double> {
    const double ahead = nearness({cell.first + rows, cell.second + columns});
    const double behind = nearness({cell.first - rows, cell.second - columns});
    if (ahead == kNowhere || behind == kNowhere) return {};
    return (ahead - behind) / (2.0 * cell_mm_);
  };
  const auto across = slope(0, 1);
  const auto down = slope(1, 0);
  if (!across || !down) return 0.0;
  const Vector3d normal = Vector3d(-*across, -*down, 1.0).normalized();
  return std::clamp(1.0 - normal.dot(light), 0.0, 1.0);
}

std::string FootView::outline() const {
  std::string path;
  for (const auto& line : silhouette(body())) {
    for (const auto& corner : line) {
      const Vector2d at = corner_ + units_per_mm_ * cell_mm_ * (corner + Vector2d(0.5, 0.5));
      path += fmt::format("{}{:.1f} {:.1f}", &corner == &line.front() ? "M" : "L", at.x(), at.y());
    }
    path += "Z";
  }
  return fmt::format("<path class=\"body\" d=\"{}\"/>\n", path);
}

/// A path of dots for each class of darkness. Steps to the tenth of a millimetre of paper, each
/// from the dot before, keep it short.
std::string FootView::shading() const {
  constexpr auto kDarkest = static_cast<double>(kReliefRadius.size() - 1);
  std::array<std::string, kReliefRadius.size()> paths;
  std::array<std::pair<long, long>, kReliefRadius.size()> last = {};
  for (const auto& cell : body()) {
    const double chosen =
        std::clamp(std::round(kContrast * darkness(cell) * kDarkest), 0.0, kDarkest);
    const auto level = static_cast<std::size_t>(chosen);
    const Vector2d at = centre(cell);
    const std::pair<long, long> place(std::lround(at.x()), std::lround(at.y()));
    paths[level] +=
        fmt::format("m{} {}h0", place.first - last[level].first, place.second - last[level].second);
    last[level] = place;
  }
  std::string text;
  for (std::size_t level = 1; level < paths.size(); ++level) {
    text += fmt::format("<path class=\"relief\" stroke-width=\"{:.1f}\" d=\"{}\"/>\n",
                        2.0 * kReliefRadius[level] * cell_mm_ * units_per_mm_, paths[level]);
  }
  return text;
}

}  // namespace instep
