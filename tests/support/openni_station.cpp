#include "tests/support/openni_station.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

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

std::string OpenniStation::camera_tables() const {
  std::ostringstream text;
  text.precision(17);
  text << std::showpoint;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    text << "[[camera]]\nkind = \"openni2\"\nname = \"" << geometries_[i].id << "\"\nserial = \""
         << sensors_[i].serial << "\"\nlibrary_folder = \"" << bus_.folder().string()
         << "\"\nstation_from_camera = [";
    const auto& pose = geometries_[i].station_from_camera.matrix();
    for (int k = 0; k < 16; ++k) text << (k > 0 ? ", " : "") << pose(k / 4, k % 4);
    text << "]\n";
  }
  return text.str();
}

}  // namespace instep::test
