#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace instep {

/// From where to where something reaches along a direction.
struct Extent {
  double from = 0.0;
  double to = 0.0;

  /// Of nothing yet: what is included first is all of it.
  static Extent none() {
    return {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  }

  bool is_none() const { return to < from; }
  double length() const { return to - from; }

  void include(double place) {
    from = std::min(from, place);
    to = std::max(to, place);
  }
  void include(const Extent& other) {
    from = std::min(from, other.from);
    to = std::max(to, other.to);
  }

  /// Whether any of an interval lies in it, the ends of both included.
  bool meets(double first, double last) const { return last >= from && first <= to; }
};

/// Of at least one point, on a plane or in space, along a unit direction.
template <typename Vector>
Extent extent_along(const std::vector<Vector>& points, const Vector& direction) {
  Extent extent = Extent::none();
  for (const auto& point : points) extent.include(direction.dot(point));
  return extent;
}

}  // namespace instep
