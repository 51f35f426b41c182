#include "core/surface/patches/sheet_rows.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace instep {
namespace {

constexpr int kDirections = 4;  ///< to either side
constexpr double kDirectionsApart = 0.05;
/// Points further apart, across the rows, than this part of what they would be if each had a row of
/// its own are on two.
constexpr double kOnOneRow = 0.5;
/// With more rows for each point the points are on none: with 0.3 a random quarter of a last's
/// vertices would be on those of the lattice that it is of.
constexpr double kMostRows = 0.2;

SheetRows rows_across(const std::vector<OrientedPoint>& points, const Eigen::Vector3d& across) {
  std::vector<double> ways;
  ways.reserve(points.size());
  for (const auto& point : points) ways.push_back(across.dot(point.position));
  std::sort(ways.begin(), ways.end());
  const double width = ways.back() - ways.front();
  const double step = kOnOneRow * width / static_cast<double>(ways.size());
  SheetRows rows{1, 0.0};
  for (std::size_t i = 1; i < ways.size(); ++i) {
    if (ways[i] - ways[i - 1] > step) ++rows.count;
  }
  if (rows.count > 1) rows.apart = width / static_cast<double>(rows.count - 1);
  return rows;
}

}  // namespace

std::optional<SheetRows> rows_along(const std::vector<OrientedPoint>& points,
                                    const Eigen::Vector3d& along, const Eigen::Vector3d& outward) {
  const Eigen::Vector3d across = outward.cross(along).normalized();
  std::optional<SheetRows> fewest;
  for (int i = -kDirections; i <= kDirections; ++i) {
    const double angle = kDirectionsApart * i;
    const SheetRows rows = rows_across(points, std::cos(angle) * across + std::sin(angle) * along);
    // Askew to the rows, these seem wider.
    if (!fewest || rows.count < fewest->count ||
        (rows.count == fewest->count && rows.apart < fewest->apart)) {
      fewest = rows;
    }
  }
  if (static_cast<double>(fewest->count) > kMostRows * static_cast<double>(points.size()))
    return std::nullopt;
  return fewest;
}

}  // namespace instep
