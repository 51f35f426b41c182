#include "sim/station_layout.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/degree.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Focal length of the PrimeSense optics as a share of the image width: 575.8 px of 640.
constexpr double kFocalLengthPerWidth = 575.8 / 640.0;
constexpr double kDistanceMm = 500.0;  // from the eye to the point looked at
constexpr double kTargetHeightMm = 60.0;
// Above the horizon; cameras alternate between the two.
constexpr double kHighElevationDeg = 35.0;
constexpr double kLowElevationDeg = 10.0;

RigidTransform looking_at(const Vector3d& target, const Vector3d& eye) {
  const Vector3d forward = (target - eye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  RigidTransform station_from_camera = RigidTransform::Identity();
  station_from_camera.linear().col(0) = right;
  station_from_camera.linear().col(1) = forward.cross(right);
  station_from_camera.linear().col(2) = forward;
  station_from_camera.translation() = eye;
  return station_from_camera;
}

CameraIntrinsics lens_of(const LayoutSettings& settings) {
  CameraIntrinsics lens;
  lens.width = settings.width_px;
  lens.height = settings.height_px;
  lens.fx = lens.fy = kFocalLengthPerWidth * settings.width_px;
  lens.cx = 0.5 * (settings.width_px - 1);
  lens.cy = 0.5 * (settings.height_px - 1);
  return lens;
}

std::string name_of(int camera, int cameras) {
  constexpr std::array kFour = {"front", "left", "back", "right"};
  if (cameras == 4) return kFour[static_cast<std::size_t>(camera)];
  return fmt::format("camera-{}", camera + 1);
}

bool within(int value, int lowest, int highest) {
  return value >= lowest && value <= highest;
}

}  // namespace

Result<std::vector<CameraGeometry>> lay_out_station(const LayoutSettings& settings) {
  const auto refuse = [](const std::string& what, const char* range) {
    return fail(ErrorCode::kInvalidInput, "a simulated station cannot have " + what,
                fmt::format("choose {}", range));
  };
  if (!within(settings.cameras, 1, 16)) {
    return refuse(fmt::format("{} cameras", settings.cameras), "1 to 16");
  }
  if (!within(settings.width_px, 16, 4096) || !within(settings.height_px, 16, 4096)) {
    return refuse(fmt::format("images of {} x {}", settings.width_px, settings.height_px),
                  "16 to 4096 pixels a side");
  }
  std::vector<CameraGeometry> cameras;
  const Vector3d target(0.0, 0.0, kTargetHeightMm);
  for (int i = 0; i < settings.cameras; ++i) {
    const double azimuth = kDegree * (360.0 * i / settings.cameras);
    const double elevation = kDegree * (i % 2 == 0 ? kHighElevationDeg : kLowElevationDeg);
    const Vector3d towards_eye(std::cos(elevation) * std::cos(azimuth),
                               std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    const Vector3d eye = target + kDistanceMm * towards_eye;
    cameras.push_back({name_of(i, settings.cameras), lens_of(settings), looking_at(target, eye)});
  }
  return cameras;
}

}  // namespace instep
