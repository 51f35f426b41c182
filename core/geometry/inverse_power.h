#pragma once

#include <Eigen/Core>

namespace instep {

/// The unit eigenvector of the smallest eigenvalue of a covariance (symmetric, positive
/// semi-definite), by the inverse power method (the paper, section 4.2). Its sign means nothing.
///
/// The paper inverts the covariance itself, which has no inverse where points lie exactly on a
/// plane: three quarters and more of the neighbourhoods of an axis-aligned box. Here a billionth of
/// its trace is added to the diagonal first, which moves no eigenvector. A covariance of zero, or
/// one that is not finite, gives the third axis.
Eigen::Vector3d smallest_axis(const Eigen::Matrix3d& covariance);

}  // namespace instep
