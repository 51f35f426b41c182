#include "core/surface/cylinder_rule.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace instep {
namespace {

/// Part of all points that a cylinder has to hold: one in ten.
constexpr std::size_t kPart = 10;

}  // namespace

CylinderRule::CylinderRule(const std::vector<Eigen::Vector3d>& points, double first_radius)
    : points_(&points), first_radius_(first_radius) {}

AxisRange CylinderRule::range(Eigen::Index axis, const Eigen::Vector3d& place) const {
  std::vector<double> squared_distances;
  squared_distances.reserve(points_->size());
  for (const auto& point : *points_) {
    Eigen::Vector3d offset = point - place;
    offset[axis] = 0.0;
    squared_distances.push_back(offset.squaredNorm());
  }
  // The radius has to reach the nearest tenth, so it need not be counted at every doubling.
  std::vector<double> ordered = squared_distances;
  const std::size_t wanted = (points_->size() + kPart - 1) / kPart;
  const auto last = ordered.begin() + static_cast<std::ptrdiff_t>(wanted - 1);
  std::nth_element(ordered.begin(), last, ordered.end());
  double radius = first_radius_;
  while (radius * radius < *last) radius *= 2.0;

  AxisRange range{std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < points_->size(); ++i) {
    if (squared_distances[i] > radius * radius) continue;
    range.low = std::min(range.low, (*points_)[i][axis]);
    range.high = std::max(range.high, (*points_)[i][axis]);
  }
  return range;
}

}  // namespace instep
