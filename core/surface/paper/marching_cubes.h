#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <optional>

#include "core/geometry/triangle_mesh.h"
#include "core/result.h"

namespace instep {

/// A grid of unit cubes: `counts` of them along each axis, from the corner `origin`.
struct CubeGrid {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double cube = 1.0;  ///< length of a cube's edge, > 0
  Eigen::Vector3i counts = Eigen::Vector3i::Zero();

  /// The grid that covers a box, and half a cube more on every side.
  static Result<CubeGrid> covering(const Eigen::AlignedBox3d& box, double cube);

  Eigen::Vector3d corner(const Eigen::Vector3i& place) const {
    return origin + cube * place.cast<double>();
  }
  Eigen::Vector3d middle(const Eigen::Vector3i& place) const {
    return origin + cube * (place.cast<double>().array() + 0.5).matrix();
  }
};

/// Most corners that a grid may have; CubeGrid::covering() refuses more (kInvalidInput).
inline constexpr std::size_t kMostGridCorners = 40'000'000;

/// What marching cubes reads: a field that is positive inside, negative outside, and may be unknown
/// at a place; which cubes count; and, where it is given, how much is done (0 to 1).
struct MarchedField {
  std::function<std::optional<double>(const Eigen::Vector3d& place)> value;
  std::function<bool(const Eigen::Vector3i& cube)> admits;
  std::function<void(double done)> progress;
};

/// The surface of a field as triangles, by marching cubes: wound counter-clockwise seen from
/// outside, corners shared between neighbouring cubes. A cube is left out if the field is unknown
/// at one of its corners or it is not admitted; it is asked for only where the surface passes. The
/// field is read once at every corner of the grid.
TriangleMesh march_cubes(const CubeGrid& grid, const MarchedField& field);

}  // namespace instep
