#pragma once

#include <string>
#include <vector>

#include "sim/simulated_station.h"
#include "tests/support/openni_bus.h"

namespace instep::test {

/// A simulated station whose cameras are sensors on the OpenNI2 bus: each repeats the frames that
/// the simulated camera has made beforehand.
class OpenniStation {
 public:
  /// Plugs them all in. Throws if the settings make no station.
  OpenniStation(OpenniBus& bus, SimulationSettings settings, int frames);

  /// The [[camera]] tables of its settings file: pose and serial number, the lens left to the
  /// sensor.
  std::string camera_tables() const;

  /// The same for cameras whose places are known by a tape measure alone, each some `off_mm` off.
  std::string camera_tables_by_tape(double off_mm) const;

  const Scene& scene() const { return scene_; }
  std::size_t size() const { return sensors_.size(); }
  const std::string& serial(std::size_t camera) const { return sensors_[camera].serial; }
  const std::string& name(std::size_t camera) const { return geometries_[camera].id; }
  const RigidTransform& station_from_camera(std::size_t camera) const {
    return geometries_[camera].station_from_camera;
  }
  /// In again, somewhere else, after OpenniBus::unplug().
  void plug_in(std::size_t camera) { bus_.plug_in(sensors_[camera]); }

 private:
  std::string table_of(std::size_t camera, const std::string& pose) const;

  OpenniBus& bus_;
  Scene scene_;
  std::vector<CameraGeometry> geometries_;
  std::vector<BusSensor> sensors_;
};

}  // namespace instep::test
