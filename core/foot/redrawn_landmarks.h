#pragma once

#include <optional>
#include <vector>

#include "core/foot/foot_scan.h"

namespace instep {

/// How sure landmarks are, told by finding them again on parts of the points: the floor, the axis
/// and all rules anew, so that whatever hangs on whatever is counted with it.
///
/// The points are parted by a hash of their coordinates into two to eight parts, as many as leave
/// 7000 points to each, as often as it takes to have eight parts or more. What one of k parts
/// leaves open has k times the variance of what all points together do, as far as that falls with
/// their number; noise and sampling do. What all parts share, such as a hole, a fault of the
/// calibration or a rule that is not what was meant, does not show. `foot` has its landmarks. One
/// to four times the cost of landmarks.
Redraws redraw_landmarks(const FootScan& foot);

/// Half-width of the 95 % interval of a value from what the redraws gave for it, in their order
/// (nothing where one gave nothing), by Student's distribution: few parts say little about their
/// own spread. Nothing where that leaves fewer than three degrees of freedom.
std::optional<double> u95_of_redraws(const std::vector<std::optional<double>>& values,
                                     std::size_t parts);

/// The landmarks' 95 % radii, from FootScan::redraws.
void set_radii(FootScan& foot);

}  // namespace instep
