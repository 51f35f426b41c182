#include "core/fusion/frames/lens.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace instep {
namespace {

constexpr int kMostIterations = 30;
constexpr double kTolerance = 1e-10;

}  // namespace

Eigen::Vector2d distorted(const CameraIntrinsics& intrinsics, const Eigen::Vector2d& ideal) {
  const auto& [k1, k2, p1, p2, k3] = intrinsics.distortion;
  const double x = ideal.x();
  const double y = ideal.y();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

Eigen::Matrix2d distortion_jacobian(const CameraIntrinsics& intrinsics,
                                    const Eigen::Vector2d& ideal) {
  const auto& [k1, k2, p1, p2, k3] = intrinsics.distortion;
  const double x = ideal.x();
  const double y = ideal.y();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2 * (k1 + r2 * (2 * k2 + r2 * 3 * k3));  // of `radial`, along x over x
  const double mixed = slope * x * y + 2 * p1 * x + 2 * p2 * y;
  Eigen::Matrix2d jacobian;
  jacobian << radial + slope * x * x + 2 * p1 * y + 6 * p2 * x, mixed, mixed,
      radial + slope * y * y + 6 * p1 * y + 2 * p2 * x;
  return jacobian;
}

Eigen::Vector2d distorted_at(const CameraIntrinsics& intrinsics, double u, double v) {
  return {(u - intrinsics.cx) / intrinsics.fx, (v - intrinsics.cy) / intrinsics.fy};
}

std::optional<Eigen::Vector2d> undistorted(const CameraIntrinsics& intrinsics,
                                           const Eigen::Vector2d& target,
                                           const Eigen::Vector2d& start) {
  if (intrinsics.distortion == std::array<double, 5>{}) return target;
  Eigen::Vector2d ideal = start;
  for (int i = 0; i < kMostIterations; ++i) {
    const Eigen::Vector2d miss = target - distorted(intrinsics, ideal);
    const Eigen::Matrix2d jacobian = distortion_jacobian(intrinsics, ideal);
    const double determinant = jacobian.determinant();
    if (!(determinant > 1e-6) || !(jacobian(0, 0) > 0.0)) return std::nullopt;
    if (miss.cwiseAbs().maxCoeff() < kTolerance) return ideal;
    ideal += jacobian.inverse() * miss;
  }
  return std::nullopt;
}

CameraIntrinsics widened(const CameraIntrinsics& intrinsics, double factor) {
  CameraIntrinsics lens = intrinsics;
  lens.fx /= factor;
  lens.fy /= factor;
  const std::array<double, 5> powers = {2.0, 4.0, 1.0, 1.0, 6.0};  // of k1, k2, p1, p2, k3
  for (std::size_t i = 0; i < powers.size(); ++i) {
    lens.distortion[i] /= std::pow(factor, powers[i]);
  }
  return lens;
}

Eigen::Vector2d pixel_of(const CameraIntrinsics& intrinsics, const Eigen::Vector3d& in_camera) {
  const Eigen::Vector2d bent = distorted(intrinsics, in_camera.head<2>() / in_camera.z());
  return {intrinsics.fx * bent.x() + intrinsics.cx, intrinsics.fy * bent.y() + intrinsics.cy};
}

std::optional<Eigen::Vector2i> pixel_seeing(const CameraIntrinsics& intrinsics,
                                            const Eigen::Vector3d& in_camera) {
  if (!(in_camera.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d pixel = pixel_of(intrinsics, in_camera);
  const double u = std::round(pixel.x());
  const double v = std::round(pixel.y());
  if (!(u >= 0 && v >= 0 && u < intrinsics.width && v < intrinsics.height)) return std::nullopt;
  return Eigen::Vector2i(static_cast<int>(u), static_cast<int>(v));
}

}  // namespace instep
