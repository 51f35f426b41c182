#pragma once

#include <optional>
#include <vector>

#include "core/foot/foot_scan.h"
#include "core/workers.h"

namespace instep {

/// How sure landmarks are, told by finding them again on parts of the points: the floor, the axis
/// and all rules anew, so that whatever hangs on whatever is counted with it.
///
/// The points are parted by a hash of their coordinates into two to eight parts, as many as leave
/// 6000 points to each, as often as it takes to have about eight redraws. What one of k parts
/// leaves open has k times the variance of what all points together do, as far as that falls with
/// their number; noise and sampling do. Clouds of fewer than 12,000 points would leave parts that
/// show no toe or ball any more, so that each of four parts is left out instead, in two partings:
/// a jackknife, whose variance of the whole is (k - 1)^2 / k times that between redraws (Efron,
/// Tibshirani: An introduction to the bootstrap, 1993, section 11.5).
///
/// Where a scanner left its points in lines (FootScan::lines), all of one line come into the same
/// part, and each of four parts is left out: how far the next line may lie is what leaves an end or
/// a border open, and points beside each other on a line say nothing of it. Under level lines the
/// floor is put up to a line deeper as well, to each redraw another one. Intervals of a foot reach
/// about as much further at each end that lies across lines as these are apart.
///
/// What errors that neighbouring points share (LocalErrors) leave open does not fall with their
/// number: each part is asked twice, the second time with its points moved by a draw of them.
///
/// A part that does not show the foot's axis gives no landmarks. Upright skin that was put where
/// nobody saw a wall (close_sole()) is in no part.
///
/// What all parts share, such as a hole, what bent depths do to the floor, a fault of the
/// calibration or a rule that is not what was meant, does not show; of an edge or a border that no
/// point shows Landmark::deviations_off_mm tells. `foot` has its landmarks. One to four times the
/// cost of landmarks, shared by the workers; six times where parts are left out; twice that where
/// local errors are known.
Redraws redraw_landmarks(const FootScan& foot, const Workers& workers = one_after_the_other);

/// By how much the floor may lie deeper than the foot in the level lines of a scanner that stands
/// on it: as deep as the next line would have been. Zero of lines aslant, of which several cross
/// the sole, of a floor that is known and of points in no lines. O(1).
double below_last_line_mm(const FootScan& foot);

/// Half-width of the 95 % interval of a value from what the redraws gave for it, in their order
/// (nothing where one gave nothing), by Student's distribution: few redraws say little about their
/// own spread. Nothing where that leaves fewer than two degrees of freedom.
std::optional<double> u95_of_redraws(const std::vector<std::optional<double>>& values,
                                     const Parting& parting);

/// The same by what local errors leave open, from what the redraws gave without them and with them,
/// as many in the same order; 0 where there is none with them, nothing where too few gave a value.
std::optional<double> u95_of_erring(const std::vector<std::optional<double>>& values,
                                    const std::vector<std::optional<double>>& erring);

/// The same of a value that was told, from what the redraws gave for it, widened for what all of
/// them share; no narrower than the told value is off from them on average, or where points are
/// left out three times that, by which the told value itself is off (the jackknife's bias): where
/// they agree on another, it hangs on points that few of them have, as at the border of a hole.
std::optional<double> u95_by_redraws(double told, const std::vector<std::optional<double>>& values,
                                     const Parting& parting);

/// The landmarks' 95 % radii, from FootScan::redraws and Landmark::deviations_off_mm.
void set_radii(FootScan& foot);

}  // namespace instep
