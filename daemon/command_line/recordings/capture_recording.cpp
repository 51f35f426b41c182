#include "daemon/command_line/recordings/capture_recording.h"

#include <algorithm>
#include <list>
#include <optional>
#include <utility>

#include "daemon/station/camera_errors.h"
#include "daemon/station/camera_start.h"
#include "daemon/station/frame_tally.h"
#include "drivers/recording/recording_writer.h"

namespace instep {
namespace {

/// Frames that are not good are passed over, but not for ever.
constexpr int kMostBadFrames = 60;
constexpr std::chrono::seconds kFrameLimit{2};
/// Cameras have a limit of their own, which is shorter.
constexpr std::chrono::seconds kStartLimit{20};

using std::chrono::microseconds;

/// What one camera brings to a recording. It stops at the end of the scope.
class CameraAtWork {
 public:
  CameraAtWork(DepthCamera& camera, const RecordingPlan& plan) : camera_(camera), plan_(plan) {}
  ~CameraAtWork() { camera_.stop(); }
  CameraAtWork(const CameraAtWork&) = delete;
  CameraAtWork& operator=(const CameraAtWork&) = delete;

  Result<void> start(const RecordingProgress& progress) {
    const auto deadline = std::chrono::steady_clock::now() + kStartLimit;
    const auto started = start_by(camera_, deadline, [&] { return progress(0.0); });
    if (started) return {};
    const bool is_stopped = started.error().code == ErrorCode::kCancelled;
    return tl::make_unexpected(is_stopped ? recording_stopped() : named(started.error()));
  }

  /// Takes the next frame, whatever it holds, for nothing but what it tells of the clock.
  Result<void> warm_up() {
    const auto frame = next_frame();
    if (!frame) return tl::make_unexpected(frame.error());
    return {};
  }

  /// Its next good frame, with its time on the clock that all cameras have in common.
  Result<DepthFrame> take_frame() {
    auto frame = next_good_frame();
    if (!frame) return frame;
    if (frames_ == 0) first_time_ = frame->device_time;
    ++frames_;
    time_ = frame->device_time - first_time_;
    // Later frames are not to move the clock: their times would run backwards.
    is_clock_known_ = true;
    if (plan_.clocks == CameraClocks::kOfEachCamera) frame->device_time += *host_ahead_;
    return frame;
  }

  /// Of the length, from 0 to 1.
  double done() const {
    const auto& length = plan_.length;
    double done = 0.0;
    if (length.time) done = time_ / std::chrono::duration<double, std::milli>(*length.time);
    if (length.frames_per_camera) {
      done = std::max(
          done, static_cast<double>(frames_) / static_cast<double>(*length.frames_per_camera));
    }
    return std::min(done, 1.0);
  }

 private:
  Result<DepthFrame> next_frame() {
    auto frame = camera_.next_frame(kFrameLimit);
    if (!frame) return tl::make_unexpected(named(frame.error()));
    fault_ = tally_.count(*frame);
    if (fault_ == FrameFault::kNone && !is_clock_known_) note_clock(*frame);
    return frame;
  }

  Result<DepthFrame> next_good_frame() {
    for (int bad = 0; bad < kMostBadFrames; ++bad) {
      auto frame = next_frame();
      if (!frame || fault_ == FrameFault::kNone) return frame;
    }
    return tl::make_unexpected(named(bad_frames_only(fault_)));
  }

  Error named(Error error) const {
    return named_after_camera(camera_.description().geometry.id, std::move(error));
  }

  void note_clock(const DepthFrame& frame) {
    const auto host = frame.host_time.time_since_epoch();
    const auto ahead = std::chrono::duration_cast<microseconds>(host) - frame.device_time;
    host_ahead_ = std::min(ahead, host_ahead_.value_or(ahead));
  }

  DepthCamera& camera_;
  const RecordingPlan& plan_;
  FrameTally tally_;
  FrameFault fault_ = FrameFault::kNone;  ///< of the last frame
  std::optional<microseconds>
      host_ahead_;  ///< of the camera's clock, but for what frames were late
  bool is_clock_known_ = false;
  std::size_t frames_ = 0;
  microseconds first_time_{0};
  microseconds time_{0};
};

/// Writes frames with their times from the earliest one on.
class FrameSink {
 public:
  explicit FrameSink(RecordingWriter& writer) : writer_(writer) {}

  /// The first round decides which frame is the earliest.
  Result<void> add(std::vector<DepthFrame> round) {
    for (const auto& frame : round) {
      if (has_begun_) break;
      begin_ = std::min(begin_, frame.device_time);
    }
    has_begun_ = true;
    for (auto& frame : round) {
      frame.device_time = std::max(frame.device_time - begin_, microseconds(0));
      if (auto good = writer_.add_frame(frame); !good) return good;
    }
    return {};
  }

 private:
  RecordingWriter& writer_;
  bool has_begun_ = false;
  microseconds begin_ = microseconds::max();
};

using Cameras = std::vector<std::unique_ptr<DepthCamera>>;

Result<void> tell(const RecordingProgress& progress, double done) {
  if (progress(done)) return {};
  return tl::make_unexpected(recording_stopped());
}

/// All stream at once and give a frame each in turn, until the first has enough.
Result<void> record_together(const Cameras& cameras, FrameSink& sink, const RecordingPlan& plan,
                             const RecordingProgress& progress) {
  std::list<CameraAtWork> at_work;
  for (const auto& camera : cameras) {
    if (auto good = at_work.emplace_back(*camera, plan).start(progress); !good) return good;
  }
  for (int i = 0; i < plan.warmup_frames; ++i) {
    for (auto& camera : at_work) {
      if (auto good = camera.warm_up(); !good) return good;
    }
    if (auto good = tell(progress, 0.0); !good) return good;
  }
  for (double done = 0.0; done < 1.0;) {
    std::vector<DepthFrame> round;
    for (auto& camera : at_work) {
      auto frame = camera.take_frame();
      if (!frame) return tl::make_unexpected(frame.error());
      round.push_back(std::move(*frame));
      done = std::max(done, camera.done());
    }
    if (auto good = sink.add(std::move(round)); !good) return good;
    if (auto good = tell(progress, done); !good) return good;
  }
  return {};
}

/// Each streams alone until it has enough, for another's light would disturb it.
Result<void> record_in_turns(const Cameras& cameras, FrameSink& sink, const RecordingPlan& plan,
                             const RecordingProgress& progress) {
  double turns = 0.0;
  const RecordingProgress of_turn = [&](double turn) {
    return progress((turns + turn) / static_cast<double>(cameras.size()));
  };
  for (const auto& camera : cameras) {
    CameraAtWork at_work(*camera, plan);
    if (auto good = at_work.start(of_turn); !good) return good;
    for (int i = 0; i < plan.warmup_frames; ++i) {
      if (auto good = at_work.warm_up(); !good) return good;
      if (auto good = tell(of_turn, 0.0); !good) return good;
    }
    while (at_work.done() < 1.0) {
      auto frame = at_work.take_frame();
      if (!frame) return tl::make_unexpected(frame.error());
      if (auto good = sink.add({std::move(*frame)}); !good) return good;
      if (auto good = tell(of_turn, at_work.done()); !good) return good;
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
                                    Recording header, const RecordingPlan& plan,
                                    const std::filesystem::path& folder,
                                    const RecordingProgress& progress) {
  header.cameras.clear();
  for (const auto& camera : cameras) header.cameras.push_back(camera->description());
  auto writer = RecordingWriter::create(folder, std::move(header));
  if (!writer) return tl::make_unexpected(writer.error());
  FrameSink sink(*writer);
  const auto record = plan.turns == CameraTurns::kOneAtATime ? record_in_turns : record_together;
  if (auto good = record(cameras, sink, plan, progress); !good) {
    return tl::make_unexpected(good.error());
  }
  Recording recording = writer->recording();
  if (auto good = writer->finish(); !good) return tl::make_unexpected(good.error());
  return recording;
}

}  // namespace instep
