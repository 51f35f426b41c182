#include "core/fusion/surface_points.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace instep {
namespace {

constexpr int kSmallestWindow = 2;
constexpr int kLargestWindow = 6;
constexpr int kFewestNeighbours = 6;
constexpr double kDegree = std::numbers::pi / 180.0;

/// Marks the pixels round every marked one.
std::vector<std::uint8_t> dilated(const std::vector<std::uint8_t>& marked, int width, int height) {
  std::vector<std::uint8_t> grown = marked;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (!marked[static_cast<std::size_t>(v * width + u)]) continue;
      for (int y = std::max(0, v - 1); y <= std::min(height - 1, v + 1); ++y) {
        for (int x = std::max(0, u - 1); x <= std::min(width - 1, u + 1); ++x) {
          grown[static_cast<std::size_t>(y * width + x)] = 1;
        }
      }
    }
  }
  return grown;
}

/// 1/Z = c + a dx + b dy about a pixel, dx and dy being differences of ray coordinates.
struct InversePlane {
  double a;
  double b;
  double c;
};

/// Fits planes to windows of one depth image.
class NormalFitter {
 public:
  NormalFitter(const Deprojector& deprojector, const FusedDepth& depth,
               const SurfaceSettings& settings)
      : deprojector_(deprojector), depth_(depth), settings_(settings) {}

  /// Unit normal in the camera frame, towards the camera.
  std::optional<Eigen::Vector3d> normal(std::size_t pixel) const {
    const double z = depth_.depth_mm[pixel];
    const double sigma = depth_.sigma_mm[pixel];
    const double pitch = z / deprojector_.intrinsics().fx;
    const int radius = window(sigma, pitch);
    // First a loose gate: what a steep surface may show at this distance.
    const double steep = std::tan(settings_.steepest_deg * kDegree) * pitch;
    const auto near = [&](double reach, double, double, double other) {
      return std::abs(other - z) <= 4.0 * sigma + 0.5 * steep * reach;
    };
    const auto first = fit(pixel, radius, near);
    if (!first) return std::nullopt;
    const auto on_plane = [&](double, double dx, double dy, double other) {
      const double expected = 1.0 / (first->c + first->a * dx + first->b * dy);
      return std::abs(other - expected) <= 3.0 * sigma + 0.5 * pitch;
    };
    const auto second = fit(pixel, radius, on_plane);
    if (!second) return std::nullopt;
    const Eigen::Vector3f ray = deprojector_.ray(pixel);
    // The plane is a X + b Y + (c - a x0 - b y0) Z = 1, which is positive away from the camera.
    const Eigen::Vector3d away(second->a, second->b,
                               second->c - second->a * ray.x() - second->b * ray.y());
    if (!(away.norm() > 0.0)) return std::nullopt;
    return -away.normalized();
  }

 private:
  /// Half-width of the smallest window whose fit has the wanted error.
  int window(double sigma, double pitch) const {
    for (int radius = kSmallestWindow; radius < kLargestWindow; ++radius) {
      const double count = (2.0 * radius + 1) * (2.0 * radius + 1);
      const double lever = pitch * std::sqrt(count * radius * (radius + 1) / 3.0);
      if (sigma / lever <= settings_.normal_error_deg * kDegree) return radius;
    }
    return kLargestWindow;
  }

  template <typename Gate>
  std::optional<InversePlane> fit(std::size_t pixel, int radius, const Gate& gate) const {
    const int width = depth_.width;
    const int u = static_cast<int>(pixel) % width;
    const int v = static_cast<int>(pixel) / width;
    const Eigen::Vector3f centre = deprojector_.ray(pixel);
    Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    int count = 0;
    for (int y = std::max(0, v - radius); y <= std::min(depth_.height - 1, v + radius); ++y) {
      for (int x = std::max(0, u - radius); x <= std::min(width - 1, u + radius); ++x) {
        const auto other = static_cast<std::size_t>(y * width + x);
        const double z = depth_.depth_mm[other];
        if (!(z > 0.0)) continue;
        const Eigen::Vector3f ray = deprojector_.ray(other);
        const double dx = ray.x() - centre.x();
        const double dy = ray.y() - centre.y();
        if (!gate(std::max(std::abs(x - u), std::abs(y - v)), dx, dy, z)) continue;
        const Eigen::Vector3d row(dx, dy, 1.0);
        normal_matrix += row * row.transpose();
        right += row / z;
        ++count;
      }
    }
    if (count < kFewestNeighbours) return std::nullopt;
    // Ray coordinates are about a pixel over the focal length: bring them to order one.
    const double focal = deprojector_.intrinsics().fx;
    const Eigen::Vector3d scale(focal, focal, 1.0);
    normal_matrix = scale.asDiagonal() * normal_matrix * scale.asDiagonal();
    const Eigen::Matrix2d spread = normal_matrix.topLeftCorner<2, 2>();
    if (spread.determinant() < 1.0) return std::nullopt;  // all neighbours in one line
    const Eigen::Vector3d solved = normal_matrix.ldlt().solve(scale.cwiseProduct(right));
    if (!solved.allFinite()) return std::nullopt;
    return InversePlane{solved.x() * focal, solved.y() * focal, solved.z()};
  }

  const Deprojector& deprojector_;
  const FusedDepth& depth_;
  const SurfaceSettings& settings_;
};

}  // namespace

std::size_t drop_flying_pixels(const CameraIntrinsics& intrinsics, const SurfaceSettings& settings,
                               FusedDepth& depth) {
  const int width = depth.width;
  const auto steep = static_cast<float>(std::tan(settings.steepest_deg * kDegree) / intrinsics.fx);
  const auto sigmas = static_cast<float>(settings.jump_sigmas * std::numbers::sqrt2);
  std::vector<std::uint8_t> marked(depth.depth_mm.size(), 0);
  const auto compare = [&](std::size_t a, std::size_t b) {
    const float nearer = std::min(depth.depth_mm[a], depth.depth_mm[b]);
    if (!(nearer > 0.0F)) return;
    const float jump = std::abs(depth.depth_mm[a] - depth.depth_mm[b]);
    const float noise = std::max(depth.sigma_mm[a], depth.sigma_mm[b]);
    if (jump > std::max(steep * nearer, sigmas * noise)) marked[a] = marked[b] = 1;
  };
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < width; ++u) {
      const auto pixel = static_cast<std::size_t>(v * width + u);
      if (u + 1 < width) compare(pixel, pixel + 1);
      if (v + 1 < depth.height) compare(pixel, pixel + static_cast<std::size_t>(width));
    }
  }
  for (int i = 0; i < settings.erosion_px; ++i) marked = dilated(marked, width, depth.height);
  std::size_t dropped = 0;
  for (std::size_t pixel = 0; pixel < marked.size(); ++pixel) {
    if (!marked[pixel] || depth.depth_mm[pixel] == 0.0F) continue;
    depth.depth_mm[pixel] = 0.0F;
    depth.sigma_mm[pixel] = 0.0F;
    ++dropped;
  }
  return dropped;
}

PointCloud surface_points(const Deprojector& deprojector, const FusedDepth& depth,
                          const std::vector<std::uint32_t>& pixels,
                          const SurfaceSettings& settings) {
  const NormalFitter fitter(deprojector, depth, settings);
  const double least_cosine = std::cos(settings.most_incidence_deg * kDegree);
  PointCloud cloud;
  for (const std::uint32_t pixel : pixels) {
    const auto normal = fitter.normal(pixel);
    if (!normal) continue;
    const Eigen::Vector3d ray = deprojector.ray(pixel).cast<double>();
    const Eigen::Vector3d view = -ray.normalized();
    const double cosine = normal->dot(view);
    if (!(cosine >= least_cosine)) continue;
    cloud.positions.push_back(ray * double{depth.depth_mm[pixel]});
    cloud.normals.push_back(*normal);
    // An error of depth moves the point along its ray.
    cloud.sigma_mm.push_back(depth.sigma_mm[pixel] * ray.norm() * cosine);
    cloud.view_directions.push_back(view);
  }
  return cloud;
}

}  // namespace instep
