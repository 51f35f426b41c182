#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/surface/oriented_point.h"

namespace instep::test {

/// Two sheets that bend round y from an edge on, each as its normals say: circles, of which the
/// body is what lies in both.
struct BentRoof {
  double turn;   ///< at the edge, in radians
  double right;  ///< curvature of either sheet, not zero
  double left;

  /// Out of the body at `reach` along the sheet towards +x (side 1) or -x (side -1).
  Eigen::Vector3d normal(double side, double reach) const;
  Eigen::Vector3d at(double side, double reach, double y) const;

  /// Over the body.
  double distance(const Eigen::Vector3d& place) const;

  /// Exact, at random, from next to the edge on, with their normals told; those on the right come
  /// first.
  std::vector<OrientedPoint> points(std::size_t on_the_right, std::size_t on_the_left,
                                    std::uint64_t seed) const;

  /// The same with normals as they are made of points: of those round each, across the edge too.
  std::vector<OrientedPoint> bare_points(std::size_t on_the_right, std::size_t on_the_left,
                                         std::uint64_t seed) const;

 private:
  double curvature(double side) const { return side > 0.0 ? right : left; }
  double pitch(double side, double reach) const { return 0.5 * turn + curvature(side) * reach; }
};

}  // namespace instep::test
