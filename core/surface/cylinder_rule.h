#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// Lowest and highest coordinate along one axis.
struct AxisRange {
  double low = 0.0;
  double high = 0.0;

  /// Whether any of an interval lies in the range.
  bool meets(double from, double to) const { return to >= low && from <= high; }
};

/// Where a surface that reaches to infinity has to end, since the points do (the paper, section
/// 3.4, figure 3): a place counts only if, along each of the three axes, it lies between the
/// outermost points of a cylinder through it. The cylinder's radius is at first the longest edge of
/// the minimum spanning tree and is doubled until a tenth of all points lie within.
///
/// Borrows the points, which must outlive it; at least one point.
class CylinderRule {
 public:
  /// `first_radius` > 0. Points are expected in their principal frame.
  CylinderRule(const std::vector<Eigen::Vector3d>& points, double first_radius);

  /// What the cylinder along `axis` (0, 1, 2: x, y, z) through a place admits; the place's own
  /// coordinate along that axis does not matter. O(n).
  AxisRange range(Eigen::Index axis, const Eigen::Vector3d& place) const;

 private:
  const std::vector<Eigen::Vector3d>* points_;
  double first_radius_;
};

}  // namespace instep
