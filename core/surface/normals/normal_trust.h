#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// What normals that came with points are good for.
enum class NormalTrust {
  kNone,    ///< no normals out of a body: set at random, flipped here and there, all alike, inwards
  kSide,    ///< they tell inside from outside, as those fitted to noisy points or smoothed do
  kSlopes,  ///< they tell how the surface runs on from each exact point
};

/// Judged of normals round a closed section by some hundreds of neighbours: normals of which too
/// few face as their neighbour does, which all face one way, or which point inwards (their flux
/// through the section is its area, twice), tell nothing; nor do those of which more than one in
/// 300 faces as none of its neighbours, as where a stretch of the section has them at random, or
/// of which more than one pair of neighbours along the skin in two thousand faces opposite ways, as
/// round a few that are turned over: 2 to 5 % of them made girths of feet and lasts up to 26 mm
/// wrong, one in four unseen. They tell slopes where the chord between neighbours on one sheet is
/// square to the mean of their normals, as on any smooth surface up to the third order of its
/// length: by much less than the normals turn from one to the other. Noise of a degree is borne;
/// normals averaged over a crease are not, nor are noisy points, nor a few normals that are off by
/// tens of degrees: where one in twenty was, girths of lasts were up to 9 mm too short, one in four
/// outside its interval.
///
/// `normals`: unit length, one for each of the points of `index`, which differ all; the section
/// lies in the plane of x and y. O(log points).
NormalTrust trust_in(const std::vector<Eigen::Vector3d>& normals, const PointIndex& index);

/// Gives normals that are turned over amid neighbours that face alike the mean of these, and tells
/// whether there were any: one alone can dent the skin of a sparse cloud by millimetres. Of more
/// than 3,000 points, where it does not count, none. A patch of them is for trust_in().
/// O(n log n).
bool right_lone_normals(std::vector<Eigen::Vector3d>& normals, const PointIndex& index);

}  // namespace instep
