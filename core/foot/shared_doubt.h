#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "core/foot/foot_scan.h"
#include "core/geometry/point_index.h"
#include "core/girth/girth.h"

namespace instep {

/// What the errors that many points share (PointCloud::shared_errors_mm) leave open of the measures
/// of a foot: half-widths of 95 % intervals, 0 for a cloud that knows of none. To first order: the
/// skin moves, with the landmarks on it, while the floor and the tapes' planes stay. Borrows the
/// foot. Building costs O(n log n), some 5 ms for 20,000 points.
class SharedDoubt {
 public:
  explicit SharedDoubt(const FootScan& foot);

  /// Of a measure that is read off the landmarks, in its own unit.
  double of_landmarks(const std::function<Result<double>(const Landmarks&)>& measure) const;

  /// Of the stretched length: each corner of the tape lengthens it by as much as it turns there.
  double of_girth(const Girth& girth, const TapePlane& plane) const;

 private:
  /// The seen point of the cloud that stands for the skin at a place: what closes the sole goes on
  /// from the wall, and errs as that does.
  std::size_t skin_at(const Eigen::Vector3d& place) const;

  const FootScan& foot_;
  std::vector<std::size_t> seen_;    ///< points; only of a cloud with shared errors
  std::optional<PointIndex> index_;  ///< of these
  std::vector<Landmarks> moved_;     ///< the landmarks by each of these
};

}  // namespace instep
