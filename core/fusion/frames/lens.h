#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/fusion/frames/depth_frame.h"

namespace instep {

/// Brown-Conrady distortion of normalised coordinates (x = X/Z, y = Y/Z), from ideal to distorted.
Eigen::Vector2d distorted(const CameraIntrinsics& intrinsics, const Eigen::Vector2d& ideal);

/// How the distorted coordinates change with the ideal ones; a determinant that is not positive
/// means that the lens folds the image there.
Eigen::Matrix2d distortion_jacobian(const CameraIntrinsics& intrinsics,
                                    const Eigen::Vector2d& ideal);

/// The distorted coordinates of a pixel.
Eigen::Vector2d distorted_at(const CameraIntrinsics& intrinsics, double u, double v);

/// The ideal coordinates that are distorted to `target`, by Newton's method from `start`. Nothing
/// if the lens folds the image on the way or no solution is found to 1e-10.
std::optional<Eigen::Vector2d> undistorted(const CameraIntrinsics& intrinsics,
                                           const Eigen::Vector2d& target,
                                           const Eigen::Vector2d& start);

/// The lens that sees what lies across the line of sight larger by `factor` (> 0) at the same
/// depth: every ray, distorted or not, leans as much more. It folds the image where `intrinsics`
/// does.
CameraIntrinsics widened(const CameraIntrinsics& intrinsics, double factor);

/// The pixel coordinates of a point in the camera frame, with z > 0.
Eigen::Vector2d pixel_of(const CameraIntrinsics& intrinsics, const Eigen::Vector3d& in_camera);

/// The column and the row of the pixel that sees a point in the camera frame; nothing behind the
/// camera or out of its image.
std::optional<Eigen::Vector2i> pixel_seeing(const CameraIntrinsics& intrinsics,
                                            const Eigen::Vector3d& in_camera);

}  // namespace instep
