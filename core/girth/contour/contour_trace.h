#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/girth/contour/contour.h"
#include "core/surface/patches/blended_surface.h"

namespace instep {

/// Follows the zero line of the surface on the plane z = 0 from near `start`: predictor along the
/// tangent, Newton corrector along the analytic gradient, steps of at most `step`, shorter where it
/// turns. Patches are added on the way, and move the line under its first corners by a part of the
/// noise: trace once to place them, and again to read. Nothing if there is no surface near, or the
/// line strays further than `reach` from all points or does not close within `longest`.
std::optional<Contour> trace_contour(BlendedSurface& surface, const Eigen::Vector2d& start,
                                     double step, double reach, double longest);

/// The same from one end of a line that does not close: counter-clockwise round the body, to where
/// it strays further than `reach` from all points or cannot be followed. Nothing if it closes, or
/// ends after a few steps.
std::optional<Contour> trace_open_line(BlendedSurface& surface, const Eigen::Vector2d& start,
                                       double step, double reach, double longest);

}  // namespace instep
