#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// Points with the value that a field has to take at each: zero on the surface, positive inside,
/// negative outside (the paper, eq. 5).
struct SignedSamples {
  std::vector<Eigen::Vector3d> positions;
  std::vector<double> values;
};

/// Points, each with one off-surface point (the paper, section 3.2): first all points with value 0,
/// then, in the same order, each moved outwards along its normal by `distance`, with the value
/// -distance. The paper's distance is a tenth of the shortest edge of the minimum spanning tree.
/// Normals are of unit length, one for each point; distance > 0. O(n).
SignedSamples with_off_surface_points(const std::vector<Eigen::Vector3d>& points,
                                      const std::vector<Eigen::Vector3d>& normals, double distance);

}  // namespace instep
