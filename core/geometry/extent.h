#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace instep {

/// From where to where something reaches along a direction.
struct Extent {
  double from = 0.0;
  double to = 0.0;

  double length() const { return to - from; }
};

/// Of at least one point, on a plane or in space, along a unit direction.
template <typename Vector>
Extent extent_along(const std::vector<Vector>& points, const Vector& direction) {
  Extent extent{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const auto& point : points) {
    const double place = direction.dot(point);
    extent.from = std::min(extent.from, place);
    extent.to = std::max(extent.to, place);
  }
  return extent;
}

}  // namespace instep
