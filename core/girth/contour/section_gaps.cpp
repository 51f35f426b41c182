#include "core/girth/contour/section_gaps.h"

#include <algorithm>
#include <cstddef>

#include "core/geometry/polygon.h"

namespace instep {
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
    const BorderPlace place = nearest_on_border(contour, point);
    if (place.distance <= reach) ways.push_back(place.way);
  }
  std::sort(ways.begin(), ways.end());
  return largest_gap_between(ways, perimeter(contour));
}

double largest_gap(const ContourIndex& contour, const std::vector<Eigen::Vector2d>& points) {
  std::vector<double> ways;
  ways.reserve(points.size());
  for (const auto& point : points) ways.push_back(contour.foot_of(point).way);
  std::sort(ways.begin(), ways.end());
  return largest_gap_between(ways, contour.length());
}

}  // namespace instep
