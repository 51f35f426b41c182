#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/surface/neighbourhood.h"

namespace instep {

/// The noise round one place of a body whose points are exact as a rule.
struct ScatteredPlace {
  Eigen::Vector3d place;
  double sigma = 0.0;  ///< standard deviation of a point along its normal; 0 where they are exact
};

/// The noise (a standard deviation) of a neighbourhood in a crowd, if it plainly is none of the
/// surface; else 0.
double plain_scatter(const Neighbourhood& here);

/// Where the points of an exact crowd scatter, beside the places where they do not; nothing where
/// they scatter nowhere, or lie so wide apart that a crease or a bend passes for noise. `places`:
/// points along the section, three for each spacing or so, in the order in which they lie round the
/// body; as many are asked as see all of it. What a polynomial tells costs little, else
/// O(kMostInView^3) each.
std::vector<ScatteredPlace> scattered_places(const std::vector<Eigen::Vector3d>& points,
                                             const PointIndex& index,
                                             const std::vector<std::size_t>& places);

/// The noise of a point at some place: the most that the two nearest of `known` have, for a part
/// that scatters ends somewhere between them. None if fewer are known.
double scatter_at(const std::vector<ScatteredPlace>& known, const Eigen::Vector3d& place);

/// The most of all, and the root of the mean square; 0 if none is known.
double most_scatter(const std::vector<ScatteredPlace>& known);
double usual_scatter(const std::vector<ScatteredPlace>& known);

}  // namespace instep
