#include "core/fusion/views/surface_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/degree.h"
#include "core/median.h"

namespace instep {
namespace {

/// A step in depth between neighbours that no surface makes: steeper than this against the line of
/// sight and larger than so many sigmas of its noise.
constexpr double kSteepestDeg = 80.0;
constexpr double kJumpSigmas = 5.0;
constexpr double kUnsteady = 4.0;  // times the usual noise: a pixel that wavers so between frames
constexpr int kErosionPx = 1;      // further pixels dropped on both sides of a jump
/// Share of the 7 x 7 pixels round one that must hold data: where a silhouette has nothing behind
/// it, the outermost pixels are as doubtful. This takes two off a straight rim.
constexpr double kLeastFilledWindow = 0.74;
constexpr double kMostIncidenceDeg = 75.0;  // between normal and line of sight
constexpr double kNormalErrorDeg =
    4.0;  // wanted; sets the size of the window a normal is fitted in
constexpr int kSmallestWindow = 2;
constexpr int kLargestWindow = 6;
constexpr double kFewestNeighbours = 6;
constexpr int kHalfWindow = 3;  // of the window that tells a rim from a surface
constexpr int kWindow = 2 * kHalfWindow + 1;

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

/// Marks the pixels that lack so many neighbours in a window of 7 x 7 that they must lie on the
/// rim of what was seen. Single holes in a surface do not make a rim.
std::vector<std::uint8_t> rim_pixels(const FusedDepth& depth) {
  const int width = depth.width;
  const int height = depth.height;
  std::vector<std::uint8_t> marked(depth.depth_mm.size(), 0);
  std::vector<int> columns(static_cast<std::size_t>(width), 0);  // pixels with data in 7 rows
  const auto count_row = [&](int v, int sign) {
    if (v < 0 || v >= height) return;
    const float* row = depth.depth_mm.data() + static_cast<std::ptrdiff_t>(v) * width;
    for (int u = 0; u < width; ++u)
      columns[static_cast<std::size_t>(u)] += row[u] > 0.0F ? sign : 0;
  };
  const auto column = [&](int u) {
    return u < 0 || u >= width ? 0 : columns[static_cast<std::size_t>(u)];
  };
  const int least = static_cast<int>(std::ceil(kLeastFilledWindow * kWindow * kWindow));
  for (int v = -kHalfWindow; v < height; ++v) {
    count_row(v + kHalfWindow, 1);
    count_row(v - kHalfWindow - 1, -1);
    if (v < 0) continue;
    int filled = 0;
    for (int u = -kHalfWindow; u < width; ++u) {
      filled += column(u + kHalfWindow) - column(u - kHalfWindow - 1);
      if (u >= 0) marked[static_cast<std::size_t>(v * width + u)] = filled < least ? 1 : 0;
    }
  }
  return marked;
}

/// Sigma over the square of the depth that is usual in an image.
float usual_noise(const FusedDepth& depth) {
  std::vector<float> ratios;
  for (std::size_t i = 0; i < depth.depth_mm.size(); i += 7) {
    const float z = depth.depth_mm[i];
    if (z > 0.0F) ratios.push_back(depth.sigma_mm[i] / (z * z));
  }
  return median(std::move(ratios));
}

/// 1/Z = c + a x + b y about a pixel, x and y being differences of ray coordinates in pixels.
struct InversePlane {
  double a;
  double b;
  double c;
};

/// Fits planes to windows of one depth image.
class NormalFitter {
 public:
  NormalFitter(const Deprojector& deprojector, const FusedDepth& depth)
      : deprojector_(deprojector), depth_(depth) {}

  /// Unit normal in the camera frame, towards the camera.
  std::optional<Eigen::Vector3d> normal(std::size_t pixel) const {
    const double z = depth_.depth_mm[pixel];
    const double sigma = depth_.sigma_mm[pixel];
    const double pitch = z / deprojector_.intrinsics().fx;
    const int radius = window(sigma, pitch);
    // First a loose gate: what a steep surface may show at this distance.
    const double steep = std::tan(kSteepestDeg * kDegree) * pitch;
    const auto near = [&](double x, double y, double other) {
      return std::abs(other - z) <= 4.0 * sigma + 0.5 * steep * std::max(std::abs(x), std::abs(y));
    };
    const auto first = fit(pixel, radius, near);
    if (!first) return std::nullopt;
    const double reach = (3.0 * sigma + 0.5 * pitch) / (z * z);  // of inverse depth
    const auto on_plane = [&](double x, double y, double other) {
      return std::abs(1.0 / other - (first->c + first->a * x + first->b * y)) <= reach;
    };
    const auto second = fit(pixel, radius, on_plane);
    if (!second) return std::nullopt;
    const double focal = deprojector_.intrinsics().fx;
    const Eigen::Vector3f ray = deprojector_.ray(pixel);
    // The plane is a X + b Y + (c - a x0 - b y0) Z = 1, which is positive away from the camera.
    const double a = focal * second->a;
    const double b = focal * second->b;
    const Eigen::Vector3d away(a, b, second->c - a * ray.x() - b * ray.y());
    if (!(away.norm() > 0.0)) return std::nullopt;
    return -away.normalized();
  }

 private:
  /// Half-width of the smallest window whose fit has the wanted error.
  int window(double sigma, double pitch) const {
    for (int radius = kSmallestWindow; radius < kLargestWindow; ++radius) {
      const double count = (2.0 * radius + 1) * (2.0 * radius + 1);
      const double lever = pitch * std::sqrt(count * radius * (radius + 1) / 3.0);
      if (sigma / lever <= kNormalErrorDeg * kDegree) return radius;
    }
    return kLargestWindow;
  }

  template <typename Gate>
  std::optional<InversePlane> fit(std::size_t pixel, int radius, const Gate& gate) const {
    const int width = depth_.width;
    const int u = static_cast<int>(pixel) % width;
    const int v = static_cast<int>(pixel) / width;
    const Eigen::Vector3f centre = deprojector_.ray(pixel);
    // Ray coordinates are counted in pixels, which keeps the sums of one order.
    const double focal = deprojector_.intrinsics().fx;
    double n = 0, x1 = 0, y1 = 0, xx = 0, xy = 0, yy = 0, w1 = 0, xw = 0, yw = 0;
    for (int row = std::max(0, v - radius); row <= std::min(depth_.height - 1, v + radius); ++row) {
      for (int column = std::max(0, u - radius); column <= std::min(width - 1, u + radius);
           ++column) {
        const auto other = static_cast<std::size_t>(row * width + column);
        const double z = depth_.depth_mm[other];
        if (!(z > 0.0)) continue;
        const Eigen::Vector3f ray = deprojector_.ray(other);
        const double x = focal * (ray.x() - centre.x());
        const double y = focal * (ray.y() - centre.y());
        if (!gate(x, y, z)) continue;
        const double w = 1.0 / z;
        n += 1.0;
        x1 += x;
        y1 += y;
        xx += x * x;
        xy += x * y;
        yy += y * y;
        w1 += w;
        xw += x * w;
        yw += y * w;
      }
    }
    if (n < kFewestNeighbours) return std::nullopt;
    const double sxx = xx - x1 * x1 / n;
    const double sxy = xy - x1 * y1 / n;
    const double syy = yy - y1 * y1 / n;
    const double determinant = sxx * syy - sxy * sxy;
    if (determinant < 1.0) return std::nullopt;  // all neighbours in one line
    const double sxw = xw - x1 * w1 / n;
    const double syw = yw - y1 * w1 / n;
    const double a = (syy * sxw - sxy * syw) / determinant;
    const double b = (sxx * syw - sxy * sxw) / determinant;
    return InversePlane{a, b, (w1 - a * x1 - b * y1) / n};
  }

  const Deprojector& deprojector_;
  const FusedDepth& depth_;
};

}  // namespace

void drop_flying_pixels(const CameraIntrinsics& intrinsics, FusedDepth& depth) {
  const int width = depth.width;
  const auto rims = rim_pixels(depth);
  const auto steep = static_cast<float>(std::tan(kSteepestDeg * kDegree) / intrinsics.fx);
  const auto sigmas = static_cast<float>(kJumpSigmas * std::numbers::sqrt2);
  const auto unsteady = static_cast<float>(kUnsteady) * usual_noise(depth);
  std::vector<std::uint8_t> marked(depth.depth_mm.size(), 0);
  const auto compare = [&](std::size_t a, std::size_t b) {
    const float nearer = std::min(depth.depth_mm[a], depth.depth_mm[b]);
    if (!(nearer > 0.0F)) return;
    const float jump = std::abs(depth.depth_mm[a] - depth.depth_mm[b]);
    const float noise =
        std::min(std::max(depth.sigma_mm[a], depth.sigma_mm[b]), unsteady * nearer * nearer);
    if (jump > std::max(steep * nearer, sigmas * noise)) marked[a] = marked[b] = 1;
  };
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < width; ++u) {
      const auto pixel = static_cast<std::size_t>(v * width + u);
      if (u + 1 < width) compare(pixel, pixel + 1);
      if (v + 1 < depth.height) compare(pixel, pixel + static_cast<std::size_t>(width));
    }
  }
  for (int i = 0; i < kErosionPx; ++i) marked = dilated(marked, width, depth.height);
  for (std::size_t pixel = 0; pixel < marked.size(); ++pixel) {
    const float z = depth.depth_mm[pixel];
    const bool steady = depth.sigma_mm[pixel] <= unsteady * z * z;
    if ((steady && !marked[pixel] && !rims[pixel]) || z == 0.0F) continue;
    depth.depth_mm[pixel] = 0.0F;
    depth.sigma_mm[pixel] = 0.0F;
  }
}

PointCloud surface_points(const Deprojector& deprojector, const FusedDepth& depth,
                          const std::vector<std::uint32_t>& pixels) {
  const NormalFitter fitter(deprojector, depth);
  const double least_cosine = std::cos(kMostIncidenceDeg * kDegree);
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
