#include "config/poses/tape_measured_pose.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/degree.h"
#include "core/fusion/frames/camera_limits.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr const char* kStandsAt = "stands_at_mm";
constexpr const char* kLooksAt = "looks_at_mm";
constexpr const char* kRoll = "roll_deg";

/// What the top of an image points to that is not rolled.
Vector3d top_of_image(const Vector3d& forward) {
  const bool vertical = forward.head<2>().norm() < std::sin(0.1 * kDegree);
  return vertical ? Vector3d::UnitX() : Vector3d::UnitZ();
}

std::optional<Vector3d> read_place(SettingsTable& table, const char* key, SettingsFaults& faults) {
  const auto numbers = table.numbers(key, 3);
  if (numbers.empty()) return std::nullopt;
  const Vector3d place(numbers[0], numbers[1], numbers[2]);
  if (place.cwiseAbs().maxCoeff() <= kFarthestCameraMm) return place;
  faults.add(table.line(key), fmt::format("{} is more than {} m away: write millimetres",
                                          table.full(key), kFarthestCameraMm / 1000.0));
  return std::nullopt;
}

void require_both_places(const SettingsTable& table, SettingsFaults& faults) {
  for (const char* key : {kStandsAt, kLooksAt}) {
    if (table.has(key)) continue;
    faults.add(table.line(), fmt::format("{} is missing: a pose by tape measure has {} and {}, "
                                         "both [x, y, z] in millimetres",
                                         table.full(key), kStandsAt, kLooksAt));
  }
}

}  // namespace

RigidTransform station_from_camera(const TapeMeasuredPose& measured) {
  const Vector3d forward = (measured.looks_at_mm - measured.stands_at_mm).normalized();
  const Vector3d right = forward.cross(top_of_image(forward)).normalized();
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() << right, forward.cross(right), forward;
  pose.rotate(Eigen::AngleAxisd(measured.roll_deg * kDegree, Vector3d::UnitZ()));
  pose.translation() = measured.stands_at_mm;
  return pose;
}

bool has_tape_measured_pose(const SettingsTable& table) {
  return table.has(kStandsAt) || table.has(kLooksAt) || table.has(kRoll);
}

std::optional<RigidTransform> read_tape_measured_pose(SettingsTable& table,
                                                      SettingsFaults& faults) {
  TapeMeasuredPose measured;
  table.read(kRoll, measured.roll_deg, -360.0, 360.0);
  const auto stands_at = read_place(table, kStandsAt, faults);
  const auto looks_at = read_place(table, kLooksAt, faults);
  if (has_tape_measured_pose(table)) require_both_places(table, faults);
  if (!stands_at || !looks_at) return std::nullopt;
  if ((*looks_at - *stands_at).norm() < kNearestSight_mm) {
    faults.add(table.line(),
               fmt::format("{} and {} are less than {} mm apart, and the second is what the camera "
                           "has in the middle of its image: write millimetres",
                           table.full(kStandsAt), kLooksAt, kNearestSight_mm));
    return std::nullopt;
  }
  measured.stands_at_mm = *stands_at;
  measured.looks_at_mm = *looks_at;
  return station_from_camera(measured);
}

}  // namespace instep
