#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "core/girth/contour/contour_index.h"

namespace instep {

/// The widest hole that a girth bridges, against the length of its section.
inline constexpr double kWidestBridge = 0.25;
/// What is said of a stretch without seen points that is worth a warning.
inline constexpr const char* kBridgedWarning =
    "a part of the section that the scan does not show was bridged";
/// Part of a hull of points without points under it that is worth it too.
inline constexpr double kNotableGapOfHull = 0.1;

/// The longest stretch between neighbours among places on a closed line of that `length`, each
/// given by the way to it, in order; the length itself when there are none.
double largest_gap_between(const std::vector<double>& ways, double length);

/// The longest stretch of a closed contour onto which none of the points falls, when each is put on
/// the contour where it is nearest; the contour's length when there are none. Points further than
/// `reach` from the contour do not count. The contour does not repeat its first point.
/// O(points x corners).
double largest_gap(const std::vector<Eigen::Vector2d>& contour,
                   const std::vector<Eigen::Vector2d>& points,
                   double reach = std::numeric_limits<double>::infinity());

/// The same of all points, by an index of the contour: O(points) of points near it.
double largest_gap(const ContourIndex& contour, const std::vector<Eigen::Vector2d>& points);

}  // namespace instep
