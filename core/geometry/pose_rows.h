#pragma once

#include <vector>

#include "core/geometry/rigid_transform.h"

namespace instep {

/// A pose as files have it: the 16 numbers of its 4x4 matrix, row by row.
std::vector<double> pose_rows(const RigidTransform& pose);

/// Whatever they are, of 16 numbers.
Eigen::Matrix4d matrix_from_rows(const std::vector<double>& rows);

}  // namespace instep
