#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// Side R of the cubic boxes into which a cloud is divided to find neighbours (the paper, eq. 4):
/// the cube root of the volume of its bounding box over its number of points.
///
/// The paper's R is zero for a cloud in a plane. Here no extent counts for less than the longest
/// one over the square root of the number of points, so that R is then the spacing of a square grid
/// of them. Zero only if all points are equal; at least one point.
double neighbourhood_box_size(const std::vector<Eigen::Vector3d>& points);

/// Unit normals as the paper finds them (section 3.2): a point's neighbours are the points of its
/// own box and of the six boxes that share a face with it; its normal is the direction of their
/// smallest variance; normals are then turned to agree breadth first, from the point of largest z.
/// What the search does not reach, starts again from its own highest point.
///
/// Points of one box have the same neighbours, so they have the same normal, and the search may go
/// from box to box: the paper's result at the cost of one step a box. The normal of the first point
/// points away from the mean of the cloud: the paper leaves this open, and the surface is the same
/// either way.
///
/// Known weakness, kept because it is the paper's: where points are few or uneven a box holds one
/// or two, whose normal is arbitrary, and boxes without a neighbour keep a side by chance. Up to a
/// third of the normals may be turned the wrong way.
///
/// The points are expected in their principal frame (see principal_frame.h). O(n log n).
std::vector<Eigen::Vector3d> box_normals(const std::vector<Eigen::Vector3d>& points);

}  // namespace instep
