#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace instep {

/// A closed line where the surface meets the plane z = 0, counter-clockwise round the body: corners
/// that lie on it to rounding, and the direction out of the body at each.
struct Contour {
  std::vector<Eigen::Vector2d> points;
  std::vector<Eigen::Vector2d> outward;

  /// The corner after one.
  std::size_t next(std::size_t corner) const { return corner + 1 < points.size() ? corner + 1 : 0; }
  /// Length of the chord to it.
  double chord(std::size_t corner) const { return (points[next(corner)] - points[corner]).norm(); }
  /// By how much the line turns on the way to it (radians), counter-clockwise above 0.
  double turn(std::size_t corner) const;

  /// Counter-clockwise, and not on a second lap: it encloses no more than its hull does.
  bool goes_round_once() const;

  /// Length along the curve: each chord is lengthened to the arc that turns as its ends do, to the
  /// second order of the turn.
  double length() const;

  /// Length of a tape stretched round the curve: straight where it bridges hollows, and along the
  /// curve, by arcs like those of length(), where it touches; never longer than the curve.
  double tape_length() const;

  /// The curve with `parts` pieces for each chord, by cubics that meet its ends in place and
  /// direction.
  std::vector<Eigen::Vector2d> refined(int parts) const;
};

}  // namespace instep
