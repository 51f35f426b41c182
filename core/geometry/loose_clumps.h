#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// Which points are of clumps that no skin reaches: four points or more, two spacings or more from
/// all skin, that are fewer than a five hundredth of all, or fewer than a fiftieth on a heap and
/// not, as skin is, a sheet. They have each other for neighbours, so none stands alone
/// (stray_points()). What is small but sparse is a part of a skin seen less densely there: the
/// wider of its own spacing and of that of the nearest skin counts.
///
/// `spacing` > 0: of most points. None where a skin comes in more than a few large pieces, as in
/// scanned lines: the short ones of them are skin too. Which points hang together is told by cells
/// of 1.5 spacings, so that a gap of up to five may pass for none, by how they lie. Three sorts,
/// and search trees where there are clumps.
std::vector<bool> loose_clumps(const std::vector<Eigen::Vector3d>& points, double spacing);

}  // namespace instep
