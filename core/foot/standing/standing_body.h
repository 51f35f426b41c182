#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace instep {

/// What of a cloud is the body that is meant, and what lies apart from it.
struct StandingBody {
  std::vector<std::size_t> points;  ///< indices, ascending
  double apart_share = 0.0;         ///< of all points, left out
  double next_share = 0.0;          ///< the largest piece left out, over the largest piece of all
  std::size_t parts = 1;            ///< large pieces in `points`
  double gap_beside_mm = 0.0;       ///< to what was left out before the skin; 0 without any
  double beside_share = 0.0;        ///< of points left out there, over those of the body
  bool is_gap_seen = false;         ///< that gap is more than the spacing of the points
};

/// Parts the points into pieces that touch, within twice their spacing or 8 mm, whichever is more.
/// The largest piece is the body, with those pieces whose middle lies within its box, along its
/// principal axes, or by 15 mm beside it: a scan with unseen strips comes in pieces. Strays and the
/// remains of another foot are left out; but where the points are known to be of one foot, a piece
/// of at least a quarter of the largest one is a part of it: a heel with its leg, or a forefoot,
/// but nothing small that stands there. What then stands before the body's skin or touches it is
/// left out too (things_beside()). O(n log n).
StandingBody standing_body(const std::vector<Eigen::Vector3d>& points, bool is_one_foot);

}  // namespace instep
