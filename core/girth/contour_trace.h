#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/surface/blended_surface.h"

namespace instep {

/// A closed line where the surface meets the plane z = 0, counter-clockwise round the body: corners
/// that lie on it to rounding, and the direction out of the body at each.
struct Contour {
  std::vector<Eigen::Vector2d> points;
  std::vector<Eigen::Vector2d> outward;

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

/// Follows the zero line of the surface on the plane z = 0 from near `start`: predictor along the
/// tangent, Newton corrector along the analytic gradient, steps of at most `step`, shorter where it
/// turns. Patches are added on the way, and move the line under its first corners by a part of the
/// noise: trace once to place them, and again to read. Nothing if there is no surface near, or the
/// line strays further than `reach` from all points or does not close within `longest`.
std::optional<Contour> trace_contour(BlendedSurface& surface, const Eigen::Vector2d& start,
                                     double step, double reach, double longest);

}  // namespace instep
