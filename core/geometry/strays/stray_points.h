#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// Which points of a surface stand alone: a point whose own spacing, by the distance to its eighth
/// neighbour, is more than 2.2 times that of its neighbours. `spacing` > 0: of most points; where
/// cells of that size are well filled nobody is asked for neighbours.
std::vector<bool> stray_points(const PointIndex& index, double spacing);

}  // namespace instep
