#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// Lines that points of a surface lie on, close together on each and further from line to line,
/// such as the columns of a lattice or the lines of a scanner.
struct PointLines {
  Eigen::Vector3d across;  ///< unit length, on the surface
  double apart = 0.0;      ///< from line to line; for points on no lines, about their spacing
};

/// Of points all round a place of a surface: seen along `outward` (unit length), the direction in
/// which they leave the widest strips free, as all lie on the lines between them; two at least, for
/// one may be a hole. `arms`: to the points from the place. One of the strips has to lie within
/// half of `reach` (> 0), since few points are further out. To within 3 degrees and a thirty-second
/// of `reach`. O(points).
PointLines lines_among(const std::vector<Eigen::Vector3d>& arms, const Eigen::Vector3d& outward,
                       double reach);

}  // namespace instep
