#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

namespace instep {

/// The box round the points of a slab as the plane sees them, but for what strays far off; nothing
/// does where it is the box round all. Everything is measured in parts of the section: with a
/// hundredth of the points 100 mm off girths were 5 mm off or refused. Left out are points whose
/// cells, three times as wide as points of the skin are apart, hang together with few others, if
/// the box round all is far larger than that round most. Between bodies that lie further apart than
/// they are wide strays stay.
///
/// `slab`: at least one place, in whole multiples of `step`, in the order of the first coordinate,
/// `height` > 0 high. Where something is far off a thicker slab is looked at, for of the rest of a
/// body that was seen densely in a part a thin one has hardly a point: `wider` gives the slab of a
/// height. O(n), and n log n for those of the thicker one.
Eigen::AlignedBox2d section_box(
    const std::vector<Eigen::Vector3d>& slab, double height, double step,
    const std::function<std::vector<Eigen::Vector3d>(double height)>& wider);

}  // namespace instep
