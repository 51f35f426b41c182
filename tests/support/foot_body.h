#pragma once

#include "core/geometry/point_cloud.h"

namespace instep::test {

/// A made-up right foot, closed and smooth, on z = 0 with its heel at x = 0 and its toes on +x, cut
/// at 90 mm above the floor. The medial border (+y) protrudes most at 0.70 of its length, the
/// lateral one at 0.62, and the toes end on the medial side.
struct FootBody {
  double length_mm = 260.0;
  double spacing_mm = 1.5;

  PointCloud points() const;

  double medial_border(double x) const;
  double lateral_border(double x) const;
  double height(double x) const;
};

/// The same cloud seen in a mirror (y becomes -y).
PointCloud mirrored(PointCloud cloud);

/// Every second point.
PointCloud half_of(const PointCloud& cloud, std::size_t first = 0);

}  // namespace instep::test
