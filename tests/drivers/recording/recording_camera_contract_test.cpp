#include <memory>

#include "drivers/recording/recording_camera.h"
#include "drivers/recording/recording_reader.h"
#include "tests/support/camera_contract.h"
#include "tests/support/small_recording.h"
#include "tests/support/temporary_folder.h"

namespace instep::test {
namespace {

class RecordedBackend {
 public:
  RecordedBackend() {
    write_small_recording(folder_.path() / "visit");
    recording_ =
        std::make_shared<const Recording>(read_recording(folder_.path() / "visit").value());
  }
  std::unique_ptr<DepthCamera> camera() { return open({.as_recorded = false, .loop = true}); }
  /// One whose recording is over: it was made of no frame of this camera.
  std::unique_ptr<DepthCamera> silent_camera() {
    Recording without = *recording_;
    std::erase_if(without.frames, [](const auto& frame) { return frame.camera == "left"; });
    recording_ = std::make_shared<const Recording>(std::move(without));
    return open({});
  }

 private:
  std::unique_ptr<DepthCamera> open(const RecordingCameraSettings& settings) {
    return RecordingCamera::open(recording_, "left", settings).value();
  }

  TemporaryFolder folder_;
  std::shared_ptr<const Recording> recording_;
};

INSTANTIATE_TYPED_TEST_SUITE_P(RecordingCamera, CameraContract, testing::Types<RecordedBackend>);

}  // namespace
}  // namespace instep::test
