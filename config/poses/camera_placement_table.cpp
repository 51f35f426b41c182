#include "config/poses/camera_placement_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/poses/pose_matrix.h"
#include "config/poses/tape_measured_pose.h"
#include "core/fusion/frames/camera_limits.h"

namespace instep {
namespace {

/// By the matrix or by tape measure, whichever is there; what is absent or faulty stands nowhere.
void read_pose(SettingsTable& table, CameraPlacement& placement, SettingsFaults& faults) {
  const auto matrix = read_pose_matrix(table, faults);
  const auto measured = read_tape_measured_pose(table, faults);
  const bool has_matrix = table.has("station_from_camera");
  const bool has_measured = has_tape_measured_pose(table);
  if (has_matrix && has_measured) {
    faults.add(table.line(),
               "camera.station_from_camera says where the camera stands, and stands_at_mm, "
               "looks_at_mm or roll_deg say it again: keep one of the two");
  }
  if (!has_matrix && !has_measured) {
    faults.add(table.line(),
               "camera.station_from_camera is missing: where the camera stands, as the 16 numbers "
               "of a 4x4 matrix, row by row, in millimetres; or, for a camera that is to be "
               "calibrated, roughly as stands_at_mm = [x, y, z] and looks_at_mm = [x, y, z]");
  }
  placement.station_from_camera = matrix ? *matrix : measured.value_or(RigidTransform::Identity());
  placement.is_rough = measured.has_value();
}

std::optional<CameraIntrinsics> read_intrinsics(SettingsTable& camera, SettingsFaults& faults) {
  const toml::table* found = camera.table("intrinsics");
  if (found == nullptr) return std::nullopt;
  constexpr double kLargest_px = 1e6;  // check_intrinsics() judges more closely
  SettingsTable table(*found, "camera.intrinsics", faults);
  CameraIntrinsics lens;
  table.read("width", lens.width, kSmallestImageSide, kLargestImageSide);
  table.read("height", lens.height, kSmallestImageSide, kLargestImageSide);
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
  read_pose(table, placement, faults);
  placement.intrinsics = read_intrinsics(table, faults);
  return placement;
}

}  // namespace instep
