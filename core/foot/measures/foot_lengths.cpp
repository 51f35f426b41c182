#include "core/foot/measures/foot_lengths.h"

#include <cmath>

#include "core/degree.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// The vector from one landmark to another.
Result<Vector3d> between(const Landmarks& landmarks, const char* from, const char* to) {
  const auto start = position_of(landmarks, from);
  if (!start) return tl::unexpected(start.error());
  const auto end = position_of(landmarks, to);
  if (!end) return tl::unexpected(end.error());
  return Vector3d(*end - *start);
}

Result<double> height(const Landmarks& landmarks, const char* name) {
  return position_of(landmarks, name).map([](const Vector3d& place) { return place.z(); });
}

Result<double> way_along(const Landmarks& landmarks, const char* from, const char* to) {
  return between(landmarks, from, to).map([](const Vector3d& step) { return step.x(); });
}

Result<double> distance_across(const Landmarks& landmarks, const char* from, const char* to) {
  return between(landmarks, from, to).map([](const Vector3d& step) { return std::abs(step.y()); });
}

/// Of a toe before the ball, against the side of the foot from heel to ball: positive where it
/// turns inwards, whichever side that is.
Result<double> toe_angle(const Landmarks& landmarks, const char* heel, const char* ball,
                         const char* toe) {
  const auto side = between(landmarks, heel, ball);
  if (!side) return tl::unexpected(side.error());
  const auto ray = between(landmarks, ball, toe);
  if (!ray) return tl::unexpected(ray.error());
  const auto outwards = position_of(landmarks, ball);
  const double sign = outwards->y() > 0.0 ? 1.0 : -1.0;
  const auto bearing = [&](const Vector3d& step) { return std::atan2(sign * step.y(), step.x()); };
  return (bearing(*side) - bearing(*ray)) / kDegree;
}

}  // namespace

Result<Vector3d> position_of(const Landmarks& landmarks, const std::string& name) {
  const auto found = landmarks.find(name);
  if (found == landmarks.end()) {
    return fail(ErrorCode::kInsufficientData, "the landmark " + name + " was not found",
                name == "junction" || name == "medial_malleolus"
                    ? "let the scan reach higher up the leg"
                    : "scan the foot again, from all sides");
  }
  return found->second.position_mm;
}

Result<double> foot_length(const Landmarks& landmarks) {
  return way_along(landmarks, "pternion", "acropodion");
}

Result<double> foot_breadth(const Landmarks& landmarks) {
  return between(landmarks, "metatarsale_tibiale", "metatarsale_fibulare")
      .map([](const Vector3d& step) { return step.head<2>().norm(); });
}

Result<double> foot_breadth_horizontal(const Landmarks& landmarks) {
  return distance_across(landmarks, "ball_medial", "ball_lateral");
}

Result<double> heel_breadth(const Landmarks& landmarks) {
  return distance_across(landmarks, "heel_breadth_medial", "heel_breadth_lateral");
}

Result<double> ball_length(const Landmarks& landmarks) {
  return way_along(landmarks, "pternion", "metatarsale_tibiale");
}

Result<double> outside_ball_length(const Landmarks& landmarks) {
  return way_along(landmarks, "pternion", "metatarsale_fibulare");
}

Result<double> instep_height(const Landmarks& landmarks) {
  return height(landmarks, "instep_point");
}

Result<double> ball_height(const Landmarks& landmarks) {
  return height(landmarks, "ball_top");
}

Result<double> toe1_height(const Landmarks& landmarks) {
  return height(landmarks, "toe1_top");
}

Result<double> arch_height(const Landmarks& landmarks) {
  const auto found = landmarks.find("arch_point");
  if (found == landmarks.end()) {
    return fail(ErrorCode::kInsufficientData, "the arch was not seen from below",
                "scan with a camera under the glass");
  }
  return found->second.position_mm.z();
}

Result<double> toe1_angle(const Landmarks& landmarks) {
  return toe_angle(landmarks, "heel_medial", "metatarsale_tibiale", "toe1_contact");
}

Result<double> toe5_angle(const Landmarks& landmarks) {
  return toe_angle(landmarks, "heel_lateral", "metatarsale_fibulare", "toe5_contact");
}

}  // namespace instep
