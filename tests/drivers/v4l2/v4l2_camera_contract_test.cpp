#include "tests/support/camera_contract.h"
#include "tests/support/v4l2_bench.h"

namespace instep::test {
namespace {

class FakeKernelBackend {
 public:
  std::unique_ptr<DepthCamera> camera() { return bench_.camera(); }
  std::unique_ptr<DepthCamera> silent_camera() {
    bench_.kernel().change(bench_.node(), [](auto& device) { device.silent = true; });
    return bench_.camera();
  }

 private:
  V4l2Bench bench_;
};

INSTANTIATE_TYPED_TEST_SUITE_P(V4l2Camera, CameraContract, testing::Types<FakeKernelBackend>);

}  // namespace
}  // namespace instep::test
