#include "daemon/command_line/capture_recording.h"

#include <algorithm>
#include <list>

#include "daemon/station/frame_tally.h"
#include "drivers/recording/recording_writer.h"

namespace instep {
namespace {

/// Frames that are not good are passed over, but not for ever.
constexpr int kMostBadFrames = 60;
constexpr std::chrono::seconds kFrameLimit{2};

/// What one camera brings to a recording. It stops at the end of the scope.
class CameraAtWork {
 public:
  CameraAtWork(DepthCamera& camera, RecordingWriter& writer, const RecordingLength& length)
      : camera_(camera), writer_(writer), length_(length) {}
  ~CameraAtWork() { camera_.stop(); }
  CameraAtWork(const CameraAtWork&) = delete;
  CameraAtWork& operator=(const CameraAtWork&) = delete;

  Result<void> start() { return camera_.start(); }

  /// Writes its next good frame.
  Result<void> take_frame() {
    auto frame = next_good_frame();
    if (!frame) return tl::make_unexpected(frame.error());
    if (frames_ == 0) first_time_ = frame->device_time;
    frame->device_time -= first_time_;
    ++frames_;
    time_ = frame->device_time;
    return writer_.add_frame(*frame);
  }

  /// Of the length, from 0 to 1.
  double done() const {
    double done = 0.0;
    if (length_.time) done = time_ / std::chrono::duration<double, std::milli>(*length_.time);
    if (length_.frames_per_camera) {
      done = std::max(
          done, static_cast<double>(frames_) / static_cast<double>(*length_.frames_per_camera));
    }
    return std::min(done, 1.0);
  }

 private:
  Result<DepthFrame> next_good_frame() {
    FrameFault fault = FrameFault::kNone;
    for (int bad = 0; bad < kMostBadFrames; ++bad) {
      auto frame = camera_.next_frame(kFrameLimit);
      if (!frame) return frame;
      fault = tally_.count(*frame);
      if (fault == FrameFault::kNone) return frame;
    }
    return tl::make_unexpected(
        named_after_camera(camera_.description().geometry.id, bad_frames_only(fault)));
  }

  DepthCamera& camera_;
  RecordingWriter& writer_;
  const RecordingLength& length_;
  FrameTally tally_;
  std::size_t frames_ = 0;
  std::chrono::microseconds first_time_{0};
  std::chrono::microseconds time_{0};
};

using Cameras = std::vector<std::unique_ptr<DepthCamera>>;

Result<void> tell(const RecordingProgress& progress, double done) {
  if (progress(done)) return {};
  return tl::make_unexpected(recording_stopped());
}

/// All stream at once and give a frame each in turn, until the first has enough.
Result<void> record_together(const Cameras& cameras, RecordingWriter& writer,
                             const RecordingLength& length, const RecordingProgress& progress) {
  std::list<CameraAtWork> at_work;
  for (const auto& camera : cameras) {
    if (auto good = at_work.emplace_back(*camera, writer, length).start(); !good) return good;
  }
  for (double done = 0.0; done < 1.0;) {
    for (auto& camera : at_work) {
      if (auto good = camera.take_frame(); !good) return good;
      done = std::max(done, camera.done());
    }
    if (auto good = tell(progress, done); !good) return good;
  }
  return {};
}

/// Each streams alone until it has enough, for another's light would disturb it.
Result<void> record_in_turns(const Cameras& cameras, RecordingWriter& writer,
                             const RecordingLength& length, const RecordingProgress& progress) {
  double turns = 0.0;
  for (const auto& camera : cameras) {
    CameraAtWork at_work(*camera, writer, length);
    if (auto good = at_work.start(); !good) return good;
    while (at_work.done() < 1.0) {
      if (auto good = at_work.take_frame(); !good) return good;
      const double done = (turns + at_work.done()) / static_cast<double>(cameras.size());
      if (auto good = tell(progress, done); !good) return good;
    }
    ++turns;
  }
  return {};
}

}  // namespace

Error recording_stopped() {
  return {ErrorCode::kCancelled, usual_remedy(ErrorCode::kCancelled),
          "the recording was stopped, nothing of it is kept", "record again when you are ready"};
}

Result<Recording> capture_recording(const std::vector<std::unique_ptr<DepthCamera>>& cameras,
                                    Recording header, const RecordingLength& length,
                                    CameraTurns turns, const std::filesystem::path& folder,
                                    const RecordingProgress& progress) {
  header.cameras.clear();
  for (const auto& camera : cameras) header.cameras.push_back(camera->description());
  auto writer = RecordingWriter::create(folder, std::move(header));
  if (!writer) return tl::make_unexpected(writer.error());
  const auto record = turns == CameraTurns::kOneAtATime ? record_in_turns : record_together;
  if (auto good = record(cameras, *writer, length, progress); !good) {
    return tl::make_unexpected(good.error());
  }
  Recording recording = writer->recording();
  if (auto good = writer->finish(); !good) return tl::make_unexpected(good.error());
  return recording;
}

}  // namespace instep
