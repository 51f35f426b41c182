#pragma once

#include <optional>
#include <vector>

#include "core/foot/foot_scan.h"

namespace instep {

/// How sure landmarks are, told by finding them again on halves of the points: the floor, the axis
/// and all rules anew, so that whatever hangs on whatever is counted with it.
///
/// The points are parted into two halves in several ways, by a hash of their coordinates. What two
/// complementary halves differ by has four times the variance of what all points together leave
/// open, as far as that falls with their number; noise and sampling do. What all halves share, such
/// as a hole, a fault of the calibration or a rule that is not what was meant, does not show.
/// `foot` has its landmarks. Four times the cost of alignment and landmarks.
std::vector<RedrawnLandmarks> redraw_landmarks(const FootScan& foot);

/// Half-width of the 95 % interval of a value from what complementary halves gave for it (nothing
/// where a half gave none), by Student's distribution: few pairs say little about their own spread.
/// Nothing where fewer than two pairs have both.
std::optional<double> u95_of_halves(const std::vector<std::optional<double>>& values);

/// The landmarks' 95 % radii, from FootScan::redrawn.
void set_radii(FootScan& foot);

}  // namespace instep
