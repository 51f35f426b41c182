// What the simulated station costs: one exact view, one noisy frame, and a whole station.

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "sim/depth_renderer.h"
#include "sim/sensor_noise.h"
#include "sim/simulated_station.h"
#include "sim/solids/foot_solid.h"
#include "sim/station_layout.h"

namespace {

double milliseconds_of(auto&& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

}  // namespace

int main() {
  using namespace instep;
  Scene scene;
  scene.solids.push_back({std::make_shared<FootSolid>(FootParameters{})});
  scene.solids[0].station_from_solid.translation().x() = -126.0;
  const auto cameras = lay_out_station({});
  for (const CameraGeometry& camera : cameras.value()) {
    ExactView view;
    fmt::print("exact view of a foot, camera {}: {:.0f} ms\n", camera.id,
               milliseconds_of([&] { view = render_depth(scene, camera); }));
    const NoiseSettings noise;
    fmt::print("noisy frame: {:.1f} ms\n", milliseconds_of([&] { noisy_frame(view, noise, 1); }));
  }
  SimulationSettings settings;
  settings.subject = Subject::kFeet;
  fmt::print("station with two feet and four cameras: {:.0f} ms\n",
             milliseconds_of([&] { build_station(settings); }));
}
