#include "sim/simulated_camera.h"
#include "sim/station_layout.h"
#include "tests/support/camera_contract.h"

namespace instep::test {
namespace {

std::unique_ptr<DepthCamera> camera_of(Pacing pacing, bool silent) {
  LayoutSettings layout;
  layout.width_px = 64;
  layout.height_px = 48;
  SimulatedCamera::Settings settings;
  settings.geometry = lay_out_station(layout).value().front();
  settings.pacing = pacing;
  settings.faults.never_streams = silent;
  const auto view = std::make_shared<const ExactView>(render_depth({}, settings.geometry));
  return std::make_unique<SimulatedCamera>(settings, view);
}

template <Pacing pacing>
struct SimulatedBackend {
  std::unique_ptr<DepthCamera> camera() { return camera_of(pacing, false); }
  std::unique_ptr<DepthCamera> silent_camera() { return camera_of(pacing, true); }
};

using RealTime = SimulatedBackend<Pacing::kRealTime>;

/// An interrupt can only meet a waiter where time is real.
struct AsFastAsPossible : SimulatedBackend<Pacing::kAsFastAsPossible> {
  std::unique_ptr<DepthCamera> silent_camera() { return camera_of(Pacing::kRealTime, true); }
};

using Backends = testing::Types<RealTime, AsFastAsPossible>;
INSTANTIATE_TYPED_TEST_SUITE_P(SimulatedCamera, CameraContract, Backends);

}  // namespace
}  // namespace instep::test
