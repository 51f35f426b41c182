#include "config/camera_placement_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace instep {
namespace {

constexpr double kFarthestCamera_mm = 1e5;

RigidTransform read_pose(SettingsTable& table, SettingsFaults& faults) {
  const auto numbers = table.numbers("station_from_camera", 16);
  if (numbers.empty()) {
    if (!table.has("station_from_camera")) {
      faults.add(
          table.line(),
          "camera.station_from_camera is missing: where the camera stands, as the 16 numbers "
          "of a 4x4 matrix, row by row, in millimetres");
    }
    return RigidTransform::Identity();
  }
  const Eigen::Matrix4d matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  if (!is_rigid(matrix)) {
    faults.add(table.line(),
               "camera.station_from_camera is no rotation and shift: write the rows of a rigid 4x4 "
               "matrix, the last of them 0, 0, 0, 1");
    return RigidTransform::Identity();
  }
  if (matrix.topRightCorner<3, 1>().cwiseAbs().maxCoeff() > kFarthestCamera_mm) {
    faults.add(
        table.line(),
        "camera.station_from_camera puts the camera more than 100 m away: write millimetres");
    return RigidTransform::Identity();
  }
  return nearest_rigid(matrix);
}

std::optional<CameraIntrinsics> read_intrinsics(SettingsTable& camera, SettingsFaults& faults) {
  const toml::table* found = camera.table("intrinsics");
  if (found == nullptr) return std::nullopt;
  constexpr double kLargest_px = 1e6;  // check_intrinsics() judges more closely
  SettingsTable table(*found, "camera.intrinsics", faults);
  CameraIntrinsics lens;
  table.read("width", lens.width, 16, 8192);
  table.read("height", lens.height, 16, 8192);
  table.read("fx", lens.fx, 0.0, kLargest_px);
  table.read("fy", lens.fy, 0.0, kLargest_px);
  table.read("cx", lens.cx, -kLargest_px, kLargest_px);
  table.read("cy", lens.cy, -kLargest_px, kLargest_px);
  const auto distortion = table.numbers("distortion", lens.distortion.size());
  std::copy(distortion.begin(), distortion.end(), lens.distortion.begin());
  for (const char* key : {"width", "height", "fx", "fy", "cx", "cy"}) {
    if (table.has(key)) continue;
    faults.add(table.line(), fmt::format("camera.intrinsics.{} is missing: a lens is width, "
                                         "height, fx, fy, cx and cy, all in pixels",
                                         key));
    return lens;
  }
  table.finish();
  if (const auto sound = check_intrinsics(lens); !sound) {
    faults.add(table.line(), "camera.intrinsics: " + sound.error().line());
  }
  return lens;
}

}  // namespace

CameraPlacement read_camera_placement(SettingsTable& table, SettingsFaults& faults) {
  constexpr std::size_t kLongestName = 64;
  CameraPlacement placement;
  table.read("name", placement.name, kLongestName);
  if (!table.has("name")) {
    faults.add(table.line(),
               "camera.name is missing: call the camera what you call it, such as "
               "name = \"left\"");
  }
  placement.station_from_camera = read_pose(table, faults);
  placement.intrinsics = read_intrinsics(table, faults);
  return placement;
}

}  // namespace instep
