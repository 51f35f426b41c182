#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/point_index.h"

namespace instep {

/// The points of a cloud that were seen: what is known of the skin, and how far from it a place is.
/// Borrows nothing. Building costs O(n log n), 3 ms for 40,000 points, a question
/// O(log n).
class SeenSkin {
 public:
  struct Point {
    std::size_t index = 0;  ///< in the cloud
    double distance_mm = 0.0;
  };

  explicit SeenSkin(const PointCloud& cloud);

  /// The nearest to a place; nothing if no point was seen.
  std::optional<Point> nearest(const Eigen::Vector3d& place) const;

  /// Whether a place is on skin that was seen: within 2.5 mm of a point or, where these lie further
  /// apart than the 1.5 mm of a scan, as many times further.
  bool is_near(const Eigen::Vector3d& place) const;

  /// How far apart the points usually are; 0 for fewer than two.
  double spacing_mm() const { return spacing_mm_; }

 private:
  std::vector<std::size_t> points_;  ///< in the cloud
  PointIndex index_;                 ///< of these
  double spacing_mm_ = 0.0;
};

}  // namespace instep
