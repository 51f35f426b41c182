#pragma once

#include <Eigen/Geometry>

namespace instep {

/// A rotation and a shift, in millimetres. Variables are named by direction:
/// `station_from_camera * point_in_camera` is the point in the station frame.
using RigidTransform = Eigen::Isometry3d;

/// True if the matrix is finite, its rotation is orthonormal within `tolerance`, its determinant
/// is +1 and its last row is 0 0 0 1. What comes from a file is checked with this before use.
bool is_rigid(const Eigen::Matrix4d& matrix, double tolerance = 1e-3);

/// The rigid transform nearest to a matrix for which is_rigid() holds: the rounding of a file's
/// decimals is taken out of the rotation.
RigidTransform nearest_rigid(const Eigen::Matrix4d& matrix);

}  // namespace instep
