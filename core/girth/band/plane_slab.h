#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/girth/band/plane_heights.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// The points of a cloud on and beside a tape plane, each place once (of copies counts_before()
/// tells which), or averages of them, in an order that the places alone decide, so that the cloud's
/// does not matter. Places are rounded to the plane's rounding_step(), so that it does not matter
/// either where the cloud lies, or in which unit it is told.
struct PlaneSlab {
  std::vector<std::size_t> indices;     ///< in the cloud; of an average one of its points
  std::vector<Eigen::Vector3d> places;  ///< seen from the plane: x and y on it, z above it
  std::vector<double> shares;  ///< noise of each place against its point's; none if they are alike
  /// Of points of a pile that stay a standard deviation, mm, 0 of others. None if there is no pile.
  std::vector<double> errors_mm;

  double share_of(std::size_t place) const { return shares.empty() ? 1.0 : shares[place]; }
  double error_of(std::size_t place) const { return errors_mm.empty() ? 0.0 : errors_mm[place]; }
};

/// A part in 2^38 of what the plane's control points are apart.
double rounding_step(const TapePlane& plane);

/// Places in whole steps, which are the same numbers whichever unit the cloud is told in.
std::vector<Eigen::Vector3d> in_steps(std::vector<Eigen::Vector3d> places, double step);

/// Those at most `half_width` from the plane. O(n), and m log m for the m that are found.
PlaneSlab slab_of(const PointCloud& cloud, const TapePlane& plane, double half_width);

/// The same, for one whose heights are known.
PlaneSlab slab_of(const PointCloud& cloud, const TapePlane& plane, double half_width,
                  const PlaneHeights& heights);

/// Those of a slab that lie at most `half_width` from the plane, in the same order.
PlaneSlab within(const PlaneSlab& slab, double half_width);

/// Those of a slab that are not marked, in the same order. `marked`: as many as there are.
PlaneSlab without(const std::vector<bool>& marked, const PlaneSlab& slab);

/// False where the plane only touches what the points are of: hardly one of them lies on the plane
/// or beyond it.
bool is_cut(const std::vector<Eigen::Vector3d>& places);

/// Length of the shortest tape round all points at most `half_width` from the plane, by the mean of
/// its widths (Cauchy), to a hundredth. O(n), no memory.
double tape_round(const PointCloud& cloud, const TapePlane& plane, double half_width);

/// The same for all that lies about the plane: up to a hundredth of the cloud's size from it.
double tape_about(const PointCloud& cloud, const TapePlane& plane, double size);

/// Whether a line of this length goes round a crowd of points alone, being less than half as long
/// as the tape_about() all of them.
bool is_round_a_crowd(double length, double tape_about);

/// The shortest tape round all points of the slab, laid on the plane.
std::vector<Eigen::Vector2d> hull_of(const PlaneSlab& slab);

}  // namespace instep
