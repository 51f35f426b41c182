#include "core/foot/axis/axis_turn.h"

#include <cmath>
#include <vector>

#include "core/foot/axis/outline_axis.h"
#include "core/foot/landmarks/ball_points.h"
#include "core/foot/skin/border_profile.h"
#include "core/foot/skin/border_smoothing.h"
#include "core/foot/skin/foot_outline.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kHeelSmoothingMm = 5.0;
constexpr double kHeelFromShare = 0.03;  ///< further back the border is round
constexpr double kHeelToShare = 0.13;
constexpr double kBallFromShare = 0.45;
constexpr double kRaisedMm = 20.0;  ///< a heel of which nothing lies lower is raised

BorderProfile border(const Points& points, double sign, double smoothing_mm,
                     double highest_mm = kLandmarkOutlineHeightMm) {
  std::vector<Vector2d> flat;
  for (const auto& point : points) {
    if (point.z() <= highest_mm) flat.push_back(point.head<2>());
  }
  return {flat, Vector2d::UnitX(), sign * Vector2d::UnitY(), smoothing_mm};
}

std::optional<double> to_ball_centre(const Points& points, double length) {
  FootScan forefoot;
  for (const auto& point : points) {
    if (point.x() > kBallFromShare * length) forefoot.cloud.positions.push_back(point);
  }
  forefoot.landmarks["pternion"].position_mm = Vector3d::Zero();
  forefoot.landmarks["acropodion"].position_mm = length * Vector3d::UnitX();
  const FootOutline outline(forefoot);
  const auto tibiale = find_metatarsale_tibiale(outline);
  if (!tibiale) return std::nullopt;
  const auto fibulare = find_metatarsale_fibulare(outline, *tibiale);
  if (!fibulare) return std::nullopt;
  const Vector3d centre = 0.5 * (tibiale->position_mm + fibulare->position_mm);
  return std::atan2(centre.y(), centre.x());
}

/// Of the heel's breadths, from behind forwards.
std::optional<std::vector<Vector2d>> heel_middles(const Points& points, double length) {
  constexpr int kSteps = 20;
  const BorderProfile medial = border(points, 1.0, kHeelSmoothingMm);
  const BorderProfile lateral = border(points, -1.0, kHeelSmoothingMm);
  std::vector<Vector2d> middles;
  for (int i = 0; i <= kSteps; ++i) {
    const double share = kHeelFromShare + (kHeelToShare - kHeelFromShare) * i / kSteps;
    const auto inner = medial.reach(share * length);
    const auto outer = lateral.reach(share * length);
    if (!inner || !outer) return std::nullopt;
    middles.emplace_back(share * length, 0.5 * (*inner - *outer));
  }
  return middles;
}

/// Least squares over the middles.
std::optional<double> along_heel(const Points& points, double length) {
  const auto middles = heel_middles(points, length);
  if (!middles) return std::nullopt;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Vector2d right = Vector2d::Zero();
  for (const auto& middle : *middles) {
    const Vector2d row(1.0, middle.x());
    normal += row * row.transpose();
    right += middle.y() * row;
  }
  return std::atan((normal.inverse() * right).y());
}

std::optional<double> along_medial_ruler(const Points& points, double length) {
  const BorderProfile medial = border(points, 1.0, kBorderSmoothingMm);
  // Where the heel is raised the ruler would lie on the shank, and turn with the height.
  const BorderProfile low = border(points, 1.0, kBorderSmoothingMm, kRaisedMm);
  for (const double share : {kHeelFromShare, kHeelToShare}) {
    if (!low.reach(share * length)) return std::nullopt;
  }
  const auto heel = medial.furthest(0.05 * length, 0.35 * length);
  const auto ball = medial.furthest(0.60 * length, 0.80 * length);
  if (!heel || !ball) return std::nullopt;
  return std::atan2(ball->reach - heel->reach, ball->place - heel->place);
}

std::optional<double> along_outline(const Points& points) {
  const auto direction = long_direction(points);
  if (!direction) return std::nullopt;
  return std::atan(direction->y() / direction->x());
}

}  // namespace

std::optional<double> heel_middle(const Points& points, double length_mm) {
  const auto middles = heel_middles(points, length_mm);
  if (!middles) return std::nullopt;
  double sum = 0.0;
  for (const auto& middle : *middles) sum += middle.y();
  return sum / static_cast<double>(middles->size());
}

std::optional<double> axis_turn(AxisRule rule, const Points& points, double length_mm) {
  switch (rule) {
    case AxisRule::kSecondToe:
      break;
    case AxisRule::kBallCentre:
      return to_ball_centre(points, length_mm);
    case AxisRule::kHeelCentre:
      return along_heel(points, length_mm);
    case AxisRule::kMedialTangent:
      return along_medial_ruler(points, length_mm);
    case AxisRule::kOutline:
      return along_outline(points);
  }
  return std::nullopt;
}

}  // namespace instep
