#include "core/fusion/poses/seen_object.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr int kStride = 3;           // every so many pixels, both ways
constexpr double kRadiusMm = 250.0;  // about the middle of what a camera shows of it, in plan

}  // namespace

std::vector<std::uint32_t> object_pixels(const WorkingView& view, double platform_height_mm) {
  std::vector<std::uint32_t> pixels;
  std::vector<double> along;
  std::vector<double> across;
  visit_pixels(view, kStride, [&](std::size_t pixel, const Vector3d& point) {
    const double height = point.z() - platform_height_mm;
    if (height < kLeastObjectHeightMm || height > kMostObjectHeightMm) return;
    if (!is_within(point, kObjectRegionMm)) return;
    pixels.push_back(static_cast<std::uint32_t>(pixel));
    along.push_back(point.x());
    across.push_back(point.y());
  });
  if (pixels.empty()) return pixels;
  const Vector3d middle(median(std::move(along)), median(std::move(across)), 0.0);
  std::erase_if(pixels, [&](std::uint32_t pixel) {
    return !is_within(view.in_station(pixel) - middle, kRadiusMm);
  });
  return pixels;
}

std::vector<Vector3d> object_points(const WorkingView& view, double platform_height_mm) {
  std::vector<Vector3d> points;
  for (const auto pixel : object_pixels(view, platform_height_mm)) {
    points.push_back(view.in_station(pixel));
  }
  return points;
}

double turning_lever_mm(const PointCloud& object) {
  Eigen::Matrix3d sums = Eigen::Matrix3d::Zero();
  double sides = 0.0;
  for (std::size_t i = 0; i < object.size(); ++i) {
    const Vector3d& point = object.positions[i];
    const Vector3d& normal = object.normals[i];
    // About an axis at (a, b) the lever is the last of them - a * normal.y + b * normal.x.
    const Vector3d row(-normal.y(), normal.x(), point.x() * normal.y() - point.y() * normal.x());
    sums += row * row.transpose();
    sides += normal.head<2>().squaredNorm();
  }
  if (!(sides > 0.0)) return 0.0;
  const Eigen::Vector2d axis =
      sums.topLeftCorner<2, 2>().ldlt().solve(-sums.topRightCorner<2, 1>());
  const double squares = sums(2, 2) + axis.dot(sums.topRightCorner<2, 1>());
  return std::sqrt(std::max(0.0, squares) / sides);
}

}  // namespace instep
