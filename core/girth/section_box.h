#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace instep {

/// The box round the points of a slab as the plane sees them, but for what strays far off; nothing
/// does where it is the box round all. Everything is measured in parts of the section: with a
/// hundredth of the points 100 mm off girths were 5 mm off or refused. Left out are points whose
/// cells, three times as wide as points of the skin are apart, hang together with few others, if
/// the box round all is far larger than that round most. Between bodies that lie further apart than
/// they are wide strays stay.
///
/// `places`: at least one, in whole multiples of `step`, in the order of their first coordinate.
/// `height` > 0 of the slab. O(n), and n log n where something is far off.
Eigen::AlignedBox2d section_box(const std::vector<Eigen::Vector3d>& places, double height,
                                double step);

}  // namespace instep
