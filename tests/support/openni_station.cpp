#include "tests/support/openni_station.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "core/geometry/pose_rows.h"

namespace instep::test {
namespace {

double field_of_view_rad(double focal_px, int pixels) {
  return 2.0 * std::atan(0.5 * pixels / focal_px);
}

BusSensor sensor_of(DepthCamera& camera, int frames) {
  const CameraDescription& description = camera.description();
  const CameraIntrinsics& lens = description.geometry.intrinsics;
  BusSensor sensor;
  sensor.serial = description.serial;
  sensor.width = lens.width;
  sensor.height = lens.height;
  sensor.unit_um = static_cast<int>(std::lround(1000.0 * description.depth_unit_mm));
  sensor.hfov_rad = field_of_view_rad(lens.fx, lens.width);
  sensor.vfov_rad = field_of_view_rad(lens.fy, lens.height);
  if (!camera.start()) throw std::runtime_error("the simulated camera does not start");
  for (int i = 0; i < frames; ++i) {
    auto frame = camera.next_frame(std::chrono::seconds(1));
    if (!frame) throw std::runtime_error(frame.error().line());
    sensor.images.push_back(std::move(frame->raw));
  }
  return sensor;
}

/// As a TOML array, to the last bit.
std::string list(const std::vector<double>& numbers) {
  std::ostringstream text;
  text.precision(17);
  text << std::showpoint;
  for (const double number : numbers) text << (text.str().empty() ? "[" : ", ") << number;
  return text.str() + "]";
}

}  // namespace

OpenniStation::OpenniStation(OpenniBus& bus, SimulationSettings settings, int frames) : bus_(bus) {
  settings.pacing = Pacing::kAsFastAsPossible;
  auto station = build_station(settings);
  if (!station) throw std::runtime_error(station.error().line());
  scene_ = station->scene;
  for (const auto& camera : station->cameras) {
    geometries_.push_back(camera->description().geometry);
    sensors_.push_back(sensor_of(*camera, frames));
    bus_.plug_in(sensors_.back());
  }
}

std::string OpenniStation::table_of(std::size_t camera, const std::string& pose) const {
  return "[[camera]]\nkind = \"openni2\"\nname = \"" + name(camera) + "\"\nserial = \"" +
         serial(camera) + "\"\nlibrary_folder = \"" + bus_.folder().string() + "\"\n" + pose;
}

std::string OpenniStation::camera_tables() const {
  std::string tables;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const std::string pose = list(pose_rows(geometries_[i].station_from_camera));
    tables += table_of(i, "station_from_camera = " + pose + "\n");
  }
  return tables;
}

std::string OpenniStation::camera_tables_by_tape(double off_mm) const {
  std::string tables;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const auto& pose = geometries_[i].station_from_camera;
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    const Eigen::Vector3d off(sign * off_mm, 0.5 * off_mm, -sign * 0.7 * off_mm);
    const Eigen::Vector3d stands = pose.translation() + off;
    const Eigen::Vector3d looks = pose * Eigen::Vector3d(0.0, 0.0, 500.0) - off;
    tables += table_of(i, "stands_at_mm = " + list({stands.data(), stands.data() + 3}) +
                              "\nlooks_at_mm = " + list({looks.data(), looks.data() + 3}) + "\n");
  }
  return tables;
}

}  // namespace instep::test
