#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace instep {

/// Local errors of a cloud as they may be: how far each point lies outwards of the skin, mm. A sum
/// of a few dozen waves of random directions, lengths and phases, whose spectrum is that of the
/// errors' correlation (Rahimi and Recht, Random features for large-scale kernel machines, 2007);
/// both sides of a thin part err alike. The same `draw` gives the same errors; an odd one has the
/// waves of the even one before it, a quarter of their length on. Empty where none are known.
/// O(points), 0.6 us each.
std::vector<double> drawn_local_errors(const PointCloud& cloud, std::uint64_t draw);

}  // namespace instep
