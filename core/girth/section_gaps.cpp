#include "core/girth/section_gaps.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

/// Way along the contour to the place nearest to a point, if it is within reach.
std::optional<double> station(const std::vector<Eigen::Vector2d>& contour,
                              const Eigen::Vector2d& point, double reach) {
  double nearest = std::numeric_limits<double>::infinity();
  double best = 0.0;
  double way = 0.0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Eigen::Vector2d edge = contour[(i + 1) % contour.size()] - contour[i];
    const double length = edge.norm();
    const Eigen::Vector2d along = edge / (length > 0.0 ? length : 1.0);
    const double part = std::clamp(along.dot(point - contour[i]), 0.0, length);
    const double distance = (contour[i] + part * along - point).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      best = way + part;
    }
    way += length;
  }
  if (nearest > reach * reach) return std::nullopt;
  return best;
}

}  // namespace

double largest_gap_between(const std::vector<double>& ways, double length) {
  if (ways.empty()) return length;
  double gap = ways.front() + length - ways.back();
  for (std::size_t i = 1; i < ways.size(); ++i) gap = std::max(gap, ways[i] - ways[i - 1]);
  return gap;
}

double largest_gap(const std::vector<Eigen::Vector2d>& contour,
                   const std::vector<Eigen::Vector2d>& points, double reach) {
  std::vector<double> ways;
  ways.reserve(points.size());
  for (const auto& point : points) {
    if (const auto way = station(contour, point, reach)) ways.push_back(*way);
  }
  std::sort(ways.begin(), ways.end());
  return largest_gap_between(ways, perimeter(contour));
}

}  // namespace instep
