#include "config/devices/v4l2_settings_table.h"

#include <fmt/format.h>

#include <limits>

#include "config/poses/camera_placement_table.h"
#include "core/fusion/frames/camera_limits.h"

namespace instep {
namespace {

constexpr std::size_t kMostControls = 32;

V4l2Settings::Control read_control(SettingsTable& table, SettingsFaults& faults) {
  V4l2Settings::Control control;
  table.read("name", control.name, 64);
  table.read("value", control.value, std::numeric_limits<int>::min(),
             std::numeric_limits<int>::max());
  if (!table.has("name") || !table.has("value")) {
    faults.add(table.line(),
               "camera.controls: each has a name and a value, as v4l2-ctl --list-ctrls shows them");
  }
  table.finish();
  return control;
}

void check(const V4l2Settings& camera, const SettingsTable& table, SettingsFaults& faults) {
  if (!table.has("serial") && !table.has("bus_path")) {
    faults.add(table.line(),
               "camera.serial is missing: give it, or bus_path, to tell which camera is meant; "
               "/dev/videoN changes");
  }
  if (!table.has("depth_unit_mm")) {
    faults.add(table.line(),
               "camera.depth_unit_mm is missing: what a raw depth of 1 is worth, such as 1.0 for a "
               "RealSense D435, 0.1 for a D405, 0.125 for an SR300; the camera does not say it");
  }
  if (!table.has("intrinsics")) {
    faults.add(table.line(),
               "camera.intrinsics is missing: a V4L2 camera does not say what lens it has");
  }
  if (camera.controls.size() > kMostControls) {
    faults.add(table.line(), fmt::format("camera.controls has {} controls, more than {}",
                                         camera.controls.size(), kMostControls));
  }
}

}  // namespace

V4l2Settings read_v4l2_settings(SettingsTable& table, SettingsFaults& faults) {
  V4l2Settings camera;
  camera.placement = read_camera_placement(table, faults);
  table.read("serial", camera.serial, 64);
  table.read("bus_path", camera.bus_path, 128);
  table.choose("format", camera.format,
               {{"Z16", V4l2Format::kZ16}, {"Y16", V4l2Format::kY16}, {"INZI", V4l2Format::kInzi}});
  table.read("depth_unit_mm", camera.depth_unit_mm, kSmallestDepthUnitMm, kLargestDepthUnitMm);
  for (const toml::table* control : table.tables("controls")) {
    SettingsTable one(*control, "camera.controls", faults);
    camera.controls.push_back(read_control(one, faults));
  }
  check(camera, table, faults);
  return camera;
}

}  // namespace instep
