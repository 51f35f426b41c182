#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// The noise round one place of a body whose points are exact as a rule.
struct ScatteredPlace {
  Eigen::Vector3d place;
  double sigma = 0.0;  ///< standard deviation of a point along its normal; 0 where they are exact
};

/// Where the points of an exact crowd scatter, beside the places where they do not; nothing where
/// they scatter nowhere, or lie so wide apart that a crease or a bend passes for noise, or scatter
/// little or everywhere. `usual`: the standard deviation that they show as a rule. `places`: points
/// along the section, three for each spacing or so, in the order in which they lie round the body;
/// of these one in 24 is asked, so that the views see all of it. A polynomial through a view costs
/// little, else O(kMostInView^3) each.
///
/// Not told: many parts of less than a fiftieth of the section; noise of more than some two
/// spacings, of which no view looks flat. Taken for noise: two layers that lie nearly as close as
/// the points, ribs or a ridge as narrow as two or three spacings.
std::vector<ScatteredPlace> scattered_places(const PointIndex& index,
                                             const std::vector<std::size_t>& places, double usual);

/// The noise of a point at some place: the most that the two nearest of `known` have, for a part
/// that scatters ends somewhere between them. None if fewer are known.
double scatter_at(const std::vector<ScatteredPlace>& known, const Eigen::Vector3d& place);

/// The most of all, and the mean; 0 if none is known.
double most_scatter(const std::vector<ScatteredPlace>& known);
double mean_scatter(const std::vector<ScatteredPlace>& known);

}  // namespace instep
