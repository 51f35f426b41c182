#include "core/girth/cloud_edge.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace instep {
namespace {

/// Points nearer to the plane, against how near they have to be, are on no side of it.
constexpr double kBeside = 0.4;
/// On one side random points leave gaps two to three times as long as that hardly ever.
constexpr double kLongGap = 2.5;
/// How far off skin is at an edge, in standard deviations of its points: of cylinders whose cut is
/// level and whose plane leans by 26 degrees 0.4 of one.
constexpr double kOffAtEdge = 0.5;
/// Against the length: less is not looked for.
constexpr double kLeastDoubt = 1e-5;

/// Of a closed line of that `length`: all long stretches without one of the places.
double length_without(std::vector<double> ways, double near, double length) {
  if (ways.empty()) return length;
  std::sort(ways.begin(), ways.end());
  double before = ways.back() - length;
  double without = 0.0;
  for (const double way : ways) {
    if (way - before > kLongGap * near) without += way - before;
    before = way;
  }
  return without;
}

}  // namespace

double length_at_edge(const PlaneBand& band, const ContourIndex& contour, double near) {
  std::vector<double> above;
  std::vector<double> below;
  for (const auto& point : band.points) {
    const double height = point.position.z();
    if (std::abs(height) > near || std::abs(height) < kBeside * near) continue;
    const auto foot = contour.foot_of(point.position.head<2>());
    if (foot.distance <= near) (height > 0.0 ? above : below).push_back(foot.way);
  }
  const double length = contour.length();
  const double missing = length_without(std::move(above), near, length) +
                         length_without(std::move(below), near, length);
  return std::min(missing, length);
}

double doubt_of_edge(const PlaneBand& band, const ContourIndex& contour, double near) {
  const double length = contour.length();
  // By as much as skin moves out a line is longer for each radian that it turns there.
  const double all_round = kOffAtEdge * band.sigma * 2.0 * std::numbers::pi;
  if (!(all_round > kLeastDoubt * length)) return 0.0;
  return all_round * length_at_edge(band, contour, near) / length;
}

}  // namespace instep
