#include "core/foot/skin/foot_outline.h"

#include <limits>

#include "core/foot/skin/border_smoothing.h"

namespace instep {
namespace {

double length_of(const FootScan& foot) {
  return foot.landmarks.at("acropodion").position_mm.x() -
         foot.landmarks.at("pternion").position_mm.x();
}

std::vector<Eigen::Vector3d> as_right_foot(const FootScan& foot, double factor) {
  const Eigen::Vector3d scale = factor * Eigen::Vector3d(1.0, foot.medial_sign(), 1.0);
  auto points = foot.shape().positions;
  for (auto& point : points) point = scale.cwiseProduct(point);
  return points;
}

/// None where all were.
std::vector<Eigen::Vector3d> those_seen(const std::vector<Eigen::Vector3d>& points,
                                        const PointCloud& cloud) {
  std::vector<Eigen::Vector3d> seen;
  if (!cloud.stands_on_platform()) return seen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (cloud.was_seen(i)) seen.push_back(points[i]);
  }
  return seen;
}

BorderView from_above(double medial_sign) {
  return {Eigen::Vector3d::UnitX(), medial_sign * Eigen::Vector3d::UnitY(),
          Eigen::Vector3d::UnitZ(), 0.0, kLandmarkOutlineHeightMm};
}

}  // namespace

FootOutline::FootOutline(const FootScan& foot)
    : factor_(full_size_factor(length_of(foot))),
      medial_sign_(foot.medial_sign()),
      points_(as_right_foot(foot, factor_)),
      seen_points_(those_seen(points_, foot.shape())),
      seen_skin_(seen_points_.empty() ? std::nullopt : std::optional<SeenSkin>(foot.cloud)),
      medial_(points_, from_above(1.0), kBorderSmoothingMm),
      lateral_(points_, from_above(-1.0), kBorderSmoothingMm) {}

Eigen::Vector3d FootOutline::on_foot(const Eigen::Vector3d& place) const {
  return Eigen::Vector3d(place.x(), medial_sign_ * place.y(), place.z()) / factor_;
}

Landmark FootOutline::in_foot_frame(Landmark landmark) const {
  landmark.position_mm = on_foot(landmark.position_mm);
  for (auto& off : landmark.deviations_off_mm) off = on_foot(off);
  return landmark;
}

bool FootOutline::was_seen(const Eigen::Vector3d& place) const {
  return !seen_skin_ || seen_skin_->is_near(on_foot(place));
}

bool FootOutline::is_told(const Eigen::Vector3d& place) const {
  constexpr double kBelowRimMm = 6.0;
  return distance_to_seen(place) <= kBelowRimMm;
}

double FootOutline::distance_to_seen(const Eigen::Vector3d& place) const {
  if (!seen_skin_) return 0.0;
  const auto nearest = seen_skin_->nearest(on_foot(place));
  return nearest ? factor_ * nearest->distance_mm : std::numeric_limits<double>::infinity();
}

}  // namespace instep
