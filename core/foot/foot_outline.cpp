#include "core/foot/foot_outline.h"

namespace instep {
namespace {

constexpr double kBorderSmoothingMm = 9.0;
constexpr double kCloseMm = 5.0;

std::vector<Eigen::Vector3d> as_right_foot(const FootScan& foot) {
  auto points = foot.cloud.positions;
  for (auto& point : points) point.y() *= foot.medial_sign();
  return points;
}

std::vector<Eigen::Vector3d> low_part(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> low;
  for (const auto& point : points) {
    if (point.z() <= kLandmarkOutlineHeightMm) low.push_back(point);
  }
  return low;
}

std::vector<Eigen::Vector2d> from_above(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector2d> flat;
  flat.reserve(points.size());
  for (const auto& point : points) flat.push_back(point.head<2>());
  return flat;
}

}  // namespace

FootOutline::FootOutline(const FootScan& foot)
    : length_mm_(foot.landmarks.at("acropodion").position_mm.x() -
                 foot.landmarks.at("pternion").position_mm.x()),
      points_(as_right_foot(foot)),
      low_points_(low_part(points_)),
      medial_(from_above(low_points_), Eigen::Vector2d::UnitX(), Eigen::Vector2d::UnitY(),
              kBorderSmoothingMm),
      lateral_(from_above(low_points_), Eigen::Vector2d::UnitX(), -Eigen::Vector2d::UnitY(),
               kBorderSmoothingMm) {}

double FootOutline::border_height(const Eigen::Vector2d& place) const {
  double sum = 0.0;
  int count = 0;
  for (const auto& point : low_points_) {
    if ((point.head<2>() - place).squaredNorm() > kCloseMm * kCloseMm) continue;
    sum += point.z();
    ++count;
  }
  return count > 0 ? sum / count : kLandmarkOutlineHeightMm / 2.0;
}

}  // namespace instep
