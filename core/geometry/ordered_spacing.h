#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace instep {

/// usual_spacing() of points that come in the order of their first coordinate, without an index of
/// them, which takes far longer to make for a few hundred questions. O(sample n) at worst; of
/// points that lie about evenly each looks at those of a strip a few spacings wide.
double usual_spacing_in_order(const std::vector<Eigen::Vector3d>& points, std::size_t sample);

}  // namespace instep
