#include "core/foot/foot_outline.h"

namespace instep {
namespace {

constexpr double kBorderSmoothingMm = 9.0;

std::vector<Eigen::Vector3d> as_right_foot(const FootScan& foot) {
  auto points = foot.cloud.positions;
  for (auto& point : points) point.y() *= foot.medial_sign();
  return points;
}

BorderView from_above(double medial_sign) {
  return {Eigen::Vector3d::UnitX(), medial_sign * Eigen::Vector3d::UnitY(),
          Eigen::Vector3d::UnitZ(), 0.0, kLandmarkOutlineHeightMm};
}

}  // namespace

FootOutline::FootOutline(const FootScan& foot)
    : length_mm_(foot.landmarks.at("acropodion").position_mm.x() -
                 foot.landmarks.at("pternion").position_mm.x()),
      points_(as_right_foot(foot)),
      was_seen_below_(!foot.cloud.stands_on_platform()),
      medial_(points_, from_above(1.0), kBorderSmoothingMm),
      lateral_(points_, from_above(-1.0), kBorderSmoothingMm) {}

}  // namespace instep
