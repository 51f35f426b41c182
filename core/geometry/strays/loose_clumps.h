#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// Which points are of clumps that no skin reaches: four points or more, that are fewer than a five
/// hundredth of all, or fewer than a fiftieth on a heap and not, as skin is, a sheet. They have
/// each other for neighbours, so none stands alone (stray_points()).
///
/// No skin reaches what is 6 mm or more, a third of its own size and two spacings from all others,
/// nor bends on to it as the skin before the gap does. So the last lines of a scanner on a tip are
/// skin, far apart as they are; and so is what is small but sparse, for the wider counts of its own
/// spacing and of that of the nearest skin.
///
/// `spacing` > 0: of most points. None where a skin comes in more than a few large pieces. Of a
/// scanner's lines on skin that is aslant to them some may be far enough from all others: do not
/// ask where there are such (scanner_lines()). Which points hang together is told by cells of 1.5,
/// 3 and 6 spacings, so that a gap of up to five may pass for none, by how they lie. Three sorts,
/// and where there are clumps search trees: O(n log n).
std::vector<bool> loose_clumps(const std::vector<Eigen::Vector3d>& points, double spacing);

}  // namespace instep
