#pragma once

#include <Eigen/Core>

namespace instep {

/// The basis function of each sample. The paper's r^3 bends as creased, uneven surfaces do; r^5
/// (with its sign turned) and r^7 as smooth and smoother ones do. They are conditionally positive
/// definite of order 2, 3 and 4: a plane, a quadratic or a cubic polynomial has to go with them.
enum class HeightKernel { kCubic, kQuintic, kSeptic };

/// Stands for the square of no distance at all where it is divided by.
inline constexpr double kLeastSquared = 1e-300;

/// Terms of the polynomial without which the kernel's system is not positive definite: 3, 6 or 10.
Eigen::Index fewest_terms(HeightKernel kernel);

/// The exponent of the distance: 3, 5 or 7.
double power_of(HeightKernel kernel);

/// The kernels between samples, the lower triangle: of their heights, each multiplied by its
/// scale from both sides.
Eigen::MatrixXd kernel_between(HeightKernel kernel, const Eigen::Matrix2Xd& places,
                               const Eigen::ArrayXd& scales);

/// The same where samples have slopes too: all heights, all slopes along x, all along y. What two
/// slopes share is the kernel's second derivative (Hermite and Birkhoff's interpolation; Wendland,
/// Scattered Data Approximation, 2005, section 16.2), which r^3 has just.
Eigen::MatrixXd sloped_kernel_between(HeightKernel kernel, const Eigen::Matrix2Xd& places,
                                      const Eigen::ArrayXd& scales);

/// The kernels of the height of each of `samples`, a row, with the height at each of `places`.
Eigen::MatrixXd kernels_at(HeightKernel kernel, const Eigen::Matrix2Xd& samples,
                           const Eigen::Matrix2Xd& places);

/// The same with rows for all heights, all slopes along x, all along y.
Eigen::MatrixXd sloped_kernels_at(HeightKernel kernel, const Eigen::Matrix2Xd& samples,
                                  const Eigen::Matrix2Xd& places);

}  // namespace instep
