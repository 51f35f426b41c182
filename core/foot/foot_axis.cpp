#include "core/foot/foot_axis.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/foot/robust_extreme.h"
#include "core/foot/second_toe.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr int kMostRounds = 12;
constexpr double kStandsStillRad = 1e-4;

Points outline_points(const Points& points, double length) {
  Points low;
  for (const auto& point : points) {
    if (point.z() <= kOutlineHeightShare * length) low.push_back(point);
  }
  return low;
}

/// Points of one end, so that the search for its extreme is short.
Points beyond(const Points& points, const Vector3d& direction, double distance) {
  Points end;
  for (const auto& point : points) {
    if (direction.dot(point) > distance) end.push_back(point);
  }
  return end.empty() ? points : end;
}

Points moved(const RigidTransform& transform, Points points) {
  for (auto& point : points) point = transform * point;
  return points;
}

/// The rearmost point of the heel and the foremost of the toes, for the x axis of `points`.
struct Ends {
  Vector3d rear;
  Vector3d front;
};

Ends find_ends(const Points& points, double length) {
  const Points heel = beyond(points, -Vector3d::UnitX(), -0.15 * length);
  const Points toes = beyond(points, Vector3d::UnitX(), 0.75 * length);
  return {robust_extreme(heel, -Vector3d::UnitX()), robust_extreme(toes, Vector3d::UnitX())};
}

/// The outline seen from above with the medial side on +y.
std::vector<Vector2d> as_right_foot(const Points& points, double medial_sign) {
  std::vector<Vector2d> outline;
  outline.reserve(points.size());
  for (const auto& point : points) outline.emplace_back(point.x(), medial_sign * point.y());
  return outline;
}

}  // namespace

FootAxis find_foot_axis(const Points& standing_points, const OutlineAxis& start, Side side) {
  const double medial_sign = side == Side::kRight ? 1.0 : -1.0;
  FootAxis axis;
  axis.foot_from_standing = start.axis_from_standing();
  const Points low = outline_points(standing_points, start.length_mm);
  for (int round = 0; round < kMostRounds; ++round) {
    Points points = moved(axis.foot_from_standing, low);
    const Vector3d rear = find_ends(points, start.length_mm).rear;
    const RigidTransform to_heel(Eigen::Translation3d(-rear.x(), -rear.y(), 0.0));
    points = moved(to_heel, std::move(points));
    const auto toe = find_second_toe(as_right_foot(points, medial_sign), start.length_mm);
    axis.foot_from_standing = to_heel * axis.foot_from_standing;
    const Ends ends = find_ends(points, start.length_mm);
    axis.pternion = ends.rear;
    axis.acropodion = ends.front;
    if (!toe) break;
    axis.is_second_toe_resolved = toe->is_resolved;
    axis.toe2_tip = {toe->tip.x(), medial_sign * toe->tip.y(), ends.front.z()};
    const double turn = std::atan2(axis.toe2_tip.y(), axis.toe2_tip.x());
    if (std::abs(turn) < kStandsStillRad) break;
    axis.foot_from_standing =
        RigidTransform(Eigen::AngleAxisd(-turn, Vector3d::UnitZ())) * axis.foot_from_standing;
  }
  return axis;
}

}  // namespace instep
