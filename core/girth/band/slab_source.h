#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/piles/pile_level.h"
#include "core/geometry/point_cloud.h"
#include "core/girth/band/plane_slab.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// Slabs of one cloud at one plane, of widths that only what they hold can tell: picks more than is
/// asked for, so that it seldom has to look through the cloud again, which it borrows.
class SlabSource {
 public:
  /// `sigma_mm`: the noise of all points, if it is told; then what the cloud tells does not count.
  /// O(n).
  SlabSource(const PointCloud& cloud, const TapePlane& plane,
             std::optional<double> sigma_mm = std::nullopt);

  const PointCloud& cloud() const { return cloud_; }
  const TapePlane& plane() const { return plane_; }
  std::optional<double> sigma_mm() const { return sigma_mm_; }

  /// Of the cloud, as the plane sees it (PlaneHeights).
  double size() const { return heights_.size(); }

  /// As slab_of() gives it, or thinned.
  PlaneSlab slab(double half_width);

  /// From now on slabs have no more of lines so far apart than thinned_lines() leaves.
  void thin_lines(double apart);
  bool is_thinned() const { return apart_.has_value(); }

  /// From now on slabs have no piles (core/geometry/piles/pile_level.h), if those at most
  /// `half_width` from the plane have some: in cells of `least_side` or more. Of a pile the points
  /// stay that the least noise is told of. Thinned slabs stay, and the level that was found first.
  void level_piles(double least_side, double half_width);

  /// Of the points of the widest slab: strays amid lines, left out by thinning.
  double stray_share() const { return stray_share_; }

 private:
  void level_widest();
  std::vector<double> told_noise(const PlaneSlab& slab) const;
  void thin_widest();

  const PointCloud& cloud_;
  TapePlane plane_;
  std::optional<double> sigma_mm_;
  PlaneHeights heights_;
  std::optional<double> apart_;     ///< of lines that are thinned
  std::optional<PileLevel> level_;  ///< in rounding steps
  double stray_share_ = 0.0;
  PlaneSlab widest_;
  double half_width_ = -1.0;  ///< of it
};

}  // namespace instep
