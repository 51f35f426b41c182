#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// What one look through a cloud tells of it at a plane. A large cloud does not fit into the
/// caches nearest to a processor, so that each look takes as long as its memory does: the heights
/// are kept in a sixth of it.
class PlaneHeights {
 public:
  /// O(n).
  PlaneHeights(const PointCloud& cloud, const TapePlane& plane);

  /// Size of the cloud as the plane sees it, so that it turns with the two: the diagonal of its box
  /// there, 0 without points.
  double size() const { return size_; }

  /// The indices of all points at most `half_width` from the plane, ascending, and of few others
  /// hardly further off. O(n), without a look at the cloud.
  std::vector<std::size_t> about(double half_width) const;

 private:
  Eigen::ArrayXf heights_;
  double size_ = 0.0;
};

}  // namespace instep
