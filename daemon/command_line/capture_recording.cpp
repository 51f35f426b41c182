#include "daemon/command_line/capture_recording.h"

#include <algorithm>

#include "drivers/recording/recording_writer.h"

namespace instep {
namespace {

/// Frames that are not good are passed over, but not for ever.
constexpr int kMostBadFrames = 60;
constexpr std::chrono::seconds kFrameLimit{2};

/// Stops all cameras at the end of the scope.
class CamerasAtWork {
 public:
  explicit CamerasAtWork(const std::vector<std::unique_ptr<DepthCamera>>& cameras)
      : cameras_(cameras) {}
  ~CamerasAtWork() {
    for (const auto& camera : cameras_) camera->stop();
  }
  CamerasAtWork(const CamerasAtWork&) = delete;
  CamerasAtWork& operator=(const CamerasAtWork&) = delete;

  Result<void> start() {
    for (const auto& camera : cameras_) {
      if (auto good = camera->start(); !good) return good;
    }
    return {};
  }

 private:
  const std::vector<std::unique_ptr<DepthCamera>>& cameras_;
};

Result<DepthFrame> next_good_frame(DepthCamera& camera) {
  for (int bad = 0; bad < kMostBadFrames; ++bad) {
    auto frame = camera.next_frame(kFrameLimit);
    if (!frame || frame->status == FrameStatus::kGood) return frame;
  }
  return fail(ErrorCode::kCorruptData,
              "camera " + camera.description().geometry.id + " gives damaged frames only",
              "check its cable");
}

}  // namespace

Result<Recording> capture_recording(const std::vector<std::unique_ptr<DepthCamera>>& cameras,
                                    Recording header, const RecordingLength& length,
                                    const std::filesystem::path& folder,
                                    const RecordingProgress& progress) {
  header.cameras.clear();
  for (const auto& camera : cameras) header.cameras.push_back(camera->description());
  auto writer = RecordingWriter::create(folder, std::move(header));
  if (!writer) return tl::make_unexpected(writer.error());
  CamerasAtWork at_work(cameras);
  if (auto good = at_work.start(); !good) return tl::make_unexpected(good.error());

  std::vector<std::chrono::microseconds> first(cameras.size());
  for (double done = 0.0, round = 0.0; done < 1.0; ++round) {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      auto frame = next_good_frame(*cameras[i]);
      if (!frame) return tl::make_unexpected(frame.error());
      if (round == 0.0) first[i] = frame->device_time;
      frame->device_time -= first[i];
      if (auto good = writer->add_frame(*frame); !good) return tl::make_unexpected(good.error());
      if (length.time)
        done = std::max(
            done, frame->device_time / std::chrono::duration<double, std::milli>(*length.time));
    }
    if (length.frames_per_camera) {
      done = std::max(done, (round + 1.0) / static_cast<double>(*length.frames_per_camera));
    }
    if (!progress(std::min(done, 1.0))) {
      return fail(ErrorCode::kCancelled, "the recording was stopped, nothing of it is kept",
                  "record again when you are ready");
    }
  }
  Recording recording = writer->recording();
  if (auto good = writer->finish(); !good) return tl::make_unexpected(good.error());
  return recording;
}

}  // namespace instep
