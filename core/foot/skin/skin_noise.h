#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// The noise of points on a foot's skin, as those round some places show it.
class SkinNoise {
 public:
  /// Of points in millimetres, in any frame. O(n log n).
  explicit SkinNoise(const std::vector<Eigen::Vector3d>& points_mm);

  /// Standard deviation along the normal of the skin, the middle one over the places: some of the
  /// points, by their numbers. Of crowded points it is told by more of them the thicker they lie.
  double deviation_mm(const std::vector<std::size_t>& places) const;

  /// The same points in another unit and about their middle: directions are those of the input.
  const PointIndex& index() const { return index_; }

 private:
  PointIndex index_;
};

}  // namespace instep
