#include "tests/support/camera_contract.h"
#include "tests/support/openni_bus.h"

namespace instep::test {
namespace {

/// The sensors of our driver module, through the stock OpenNI2 library and instep-openni.
class OpenniBackend {
 public:
  std::unique_ptr<DepthCamera> camera() { return plugged_in({}); }
  std::unique_ptr<DepthCamera> silent_camera() { return plugged_in({"stall"}); }

 private:
  std::unique_ptr<DepthCamera> plugged_in(const std::set<std::string>& faults) {
    BusSensor sensor;
    sensor.faults = faults;
    bus_.plug_in(sensor);
    return bus_.camera();
  }

  OpenniBus bus_;
};

INSTANTIATE_TYPED_TEST_SUITE_P(OpenniCamera, CameraContract, OpenniBackend);

}  // namespace
}  // namespace instep::test
