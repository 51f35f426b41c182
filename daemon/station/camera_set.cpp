#include "daemon/station/camera_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/go_on.h"
#include "daemon/loop/caught.h"
#include "daemon/loop/task_thread.h"
#include "daemon/station/camera_errors.h"
#include "daemon/station/camera_start.h"

namespace instep {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using Frames = std::vector<DepthFrame>;

constexpr milliseconds kStopGrace{300};
/// A camera that sends this many bad frames for each one asked is broken.
constexpr int kMostBadFramesForEach = 3;

/// What a camera says of itself, for others than its own thread.
class ToldDescription {
 public:
  explicit ToldDescription(const CameraDescription& told) : told_(told) {}

  void take(const CameraDescription& told) {
    const std::lock_guard lock(mutex_);
    told_ = told;
  }
  CameraDescription get() const {
    const std::lock_guard lock(mutex_);
    return told_;
  }

 private:
  mutable std::mutex mutex_;
  CameraDescription told_;
};

/// What becomes of a start that is late and goes on by itself. To whoever looks next it is left,
/// for begun anew it would be late again; after a capture it would light what nobody looks at.
enum class LateStart { kGoesOn, kIsStopped };

/// What `use` makes of the stream of a camera, which is stopped whatever comes of it, but for a
/// late start that goes on.
/// Takes down what the camera has learnt of itself at its start. `doing` as in caught().
template <class Use>
std::invoke_result_t<const Use&> with_stream(DepthCamera& camera, ToldDescription& description,
                                             std::string_view doing,
                                             steady_clock::time_point start_deadline,
                                             LateStart late_start, const GoOn& go_on,
                                             const Use& use) {
  bool goes_on = false;
  auto outcome = caught(doing, [&] {
    const auto started = start_by(camera, start_deadline, go_on);
    goes_on = late_start == LateStart::kGoesOn && !started && is_on_its_way(started.error());
    if (started) description.take(camera.description());
    return started.and_then(use);
  });
  (void)go_on();
  if (goes_on) return outcome;
  const auto stopped = caught(doing, [&]() -> Result<void> {
    camera.stop();
    return {};
  });
  if (outcome && !stopped) return tl::make_unexpected(stopped.error());
  return outcome;
}

/// Takes as many good frames as are asked for from a started camera.
Result<Frames> take_frames(DepthCamera& camera, FrameTally& tally, const CaptureSettings& settings,
                           const GoOn& go_on) {
  const auto next = [&]() -> Result<DepthFrame> {
    if (!go_on()) return cancelled();
    return camera.next_frame(settings.frame_limit);
  };
  tally.begin_stream();
  for (int i = 0; i < settings.warmup_frames; ++i) {
    const auto frame = next();
    if (!frame) return tl::make_unexpected(frame.error());
    tally.count(*frame);
  }
  const auto wanted = static_cast<std::size_t>(settings.frames_per_camera);
  Frames frames;
  int bad = 0;
  while (frames.size() < wanted) {
    auto frame = next();
    if (!frame) return tl::make_unexpected(frame.error());
    const FrameFault fault = tally.count(*frame);
    if (fault == FrameFault::kNone) {
      frames.push_back(std::move(*frame));
    } else if (++bad > kMostBadFramesForEach * settings.frames_per_camera) {
      return tl::make_unexpected(bad_frames_only(fault));
    }
  }
  return frames;
}

bool is_all_zero(const DepthFrame& frame) {
  return std::all_of(frame.raw.begin(), frame.raw.end(), [](auto depth) { return depth == 0; });
}

/// It streams, so that to wait on is no help: another stream may be.
Error without_frame(Error error) {
  if (error.code == ErrorCode::kTimeout) error.remedy = Remedy::kReopen;
  return error;
}

/// Until a frame is sound, as a stream may begin with some that are not.
Result<void> look_at(DepthCamera& camera, FrameTally& tally, const CaptureSettings& settings,
                     CameraSet::ZeroFrames zero_frames, const GoOn& go_on) {
  const auto deadline = steady_clock::now() + settings.frame_limit;
  FrameFault fault = FrameFault::kNone;
  tally.begin_stream();
  for (int i = 0; i < settings.warmup_frames + kMostBadFramesForEach; ++i) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - steady_clock::now());
    if (i > 0 && left <= std::chrono::milliseconds(0)) break;
    const auto frame = camera.next_frame(i > 0 ? left : settings.frame_limit);
    // What came before the limit tells more than that it was reached.
    if (!frame && i > 0 && frame.error().code == ErrorCode::kTimeout) break;
    if (!frame) return tl::make_unexpected(without_frame(frame.error()));
    (void)go_on();
    fault = tally.count(*frame);
    // Nobody needs to stand there, and then there may be hardly anything to be seen.
    const bool nearly_empty = fault == FrameFault::kEmpty && !is_all_zero(*frame);
    const bool as_expected =
        fault == FrameFault::kEmpty && zero_frames == CameraSet::ZeroFrames::kAreAsExpected;
    if (fault == FrameFault::kNone || nearly_empty || as_expected) return {};
  }
  return tl::make_unexpected(bad_frames_only(fault));
}

/// What went wrong in one capture: the fault of one camera, and all that have one.
class CaptureFaults {
 public:
  void blame(const std::string& camera, const Error& error) {
    // One that left shakes its whole bus, and with it the others.
    const bool explains =
        error.code == ErrorCode::kDeviceGone && first_ && first_->code != ErrorCode::kDeviceGone;
    if (!first_ || explains) first_ = error;
    at_fault_.push_back(camera);
  }

  std::optional<Error> error() const {
    std::optional<Error> error = first_;
    if (at_fault_.size() > 1) {
      error->message += fmt::format(" (cameras at fault: {})", fmt::join(at_fault_, ", "));
    }
    return error;
  }

 private:
  std::optional<Error> first_;
  std::vector<std::string> at_fault_;
};

}  // namespace

/// Who is told of the next look at a camera; nobody if none waits.
struct CameraSet::Look {
  std::mutex mutex;
  Report report;

  /// True if a look waits already.
  bool ask(const Report& asking) {
    const std::lock_guard lock(mutex);
    return static_cast<bool>(std::exchange(report, asking));
  }
  Report begin() {
    const std::lock_guard lock(mutex);
    return std::exchange(report, nullptr);
  }
};

struct CameraSet::Worker {
  explicit Worker(std::unique_ptr<DepthCamera> owned)
      : camera(std::move(owned)),
        id(camera->description().geometry.id),
        description(std::make_shared<ToldDescription>(camera->description())),
        thread(std::make_unique<TaskThread>("cam " + id)) {}

  std::shared_ptr<DepthCamera> camera;
  const std::string id;
  std::shared_ptr<ToldDescription> description;
  std::shared_ptr<FrameTally> tally = std::make_shared<FrameTally>();
  std::shared_ptr<Look> look = std::make_shared<Look>();
  std::unique_ptr<TaskThread> thread;
};

/// Where the cameras of one capture bring their frames. Shared, so that a camera that comes far too
/// late finds a place that nobody looks at any more.
struct CameraSet::Gathering {
  std::atomic<bool> cancelled = false;
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::optional<Result<Frames>>> brought;
  std::size_t free = 0;  ///< cameras that have ended what they were asked before; of turns alone

  /// Returns when no camera does what it was asked before, which lights it too, and the camera
  /// before this one has brought its frames; false if they are no longer wanted.
  bool wait_for_turn(std::size_t camera, TaskProgress& progress) {
    std::unique_lock lock(mutex);
    ++free;
    changed.notify_all();
    while (!cancelled && (free < brought.size() || (camera > 0 && !brought[camera - 1]))) {
      changed.wait_for(lock, milliseconds(20));
      progress.step();
    }
    return !cancelled;
  }

  void bring(std::size_t camera, Result<Frames> frames) {
    const std::lock_guard lock(mutex);
    brought[camera] = std::move(frames);
    changed.notify_all();
  }

  /// Until all have brought theirs, one has failed or it is late; false if `go_on` denied first.
  bool wait_for_all(steady_clock::time_point deadline, const std::function<bool()>& go_on) {
    bool wanted = true;
    std::unique_lock lock(mutex);
    while (wanted && !all_brought() && !any_failed() && steady_clock::now() < deadline) {
      changed.wait_for(lock, milliseconds(20));
      lock.unlock();
      wanted = go_on();
      lock.lock();
    }
    return wanted;
  }

  /// For those that were interrupted.
  void wait_for_late() {
    std::unique_lock lock(mutex);
    changed.wait_for(lock, kStopGrace, [&] { return all_brought(); });
  }

  bool is_complete() {
    const std::lock_guard lock(mutex);
    return all_brought();
  }

 private:
  bool all_brought() const {
    return std::all_of(brought.begin(), brought.end(), [](const auto& one) { return !!one; });
  }
  bool any_failed() const {
    return std::any_of(brought.begin(), brought.end(),
                       [](const auto& one) { return one && !one->has_value(); });
  }
};

CameraSet::CameraSet(std::vector<std::unique_ptr<DepthCamera>> cameras) {
  for (auto& camera : cameras) workers_.push_back(std::make_shared<Worker>(std::move(camera)));
}

CameraSet::~CameraSet() {
  end_by(steady_clock::now() + kStopGrace);
}

bool CameraSet::end_by(steady_clock::time_point deadline) {
  interrupt();
  bool all_ended = true;
  for (const auto& worker : workers_) all_ended = worker->thread->stop_by(deadline) && all_ended;
  return all_ended;
}

std::vector<CameraDescription> CameraSet::descriptions() const {
  std::vector<CameraDescription> all;
  for (const auto& worker : workers_) all.push_back(worker->description->get());
  return all;
}

FrameCounts CameraSet::frame_counts(std::size_t camera) const {
  return workers_[camera]->tally->counts();
}

std::uint64_t CameraSet::faulty_frames() const {
  std::uint64_t sum = 0;
  for (const auto& worker : workers_) sum += worker->tally->counts().faulty();
  return sum;
}

Result<Frames> CameraSet::capture(const CaptureSettings& settings,
                                  const std::function<bool()>& go_on) {
  const auto deadline = steady_clock::now() + settings.deadline;
  auto frames = capture_once(settings, deadline, go_on);
  const bool worth_another = !frames && frames.error().code != ErrorCode::kCancelled &&
                             frames.error().remedy != Remedy::kOperator &&
                             frames.error().remedy != Remedy::kBug;
  if (worth_another && steady_clock::now() < deadline) {
    frames = capture_once(settings, deadline, go_on);
  }
  return frames;
}

Result<Frames> CameraSet::capture_once(const CaptureSettings& settings,
                                       steady_clock::time_point deadline,
                                       const std::function<bool()>& go_on) {
  const auto gathering = ask_all(settings);
  const bool wanted = gathering->wait_for_all(deadline, go_on);
  if (!gathering->is_complete()) {
    gathering->cancelled = true;
    interrupt();
    gathering->wait_for_late();
  }
  if (!wanted) return cancelled();
  return frames_of(*gathering);
}

std::shared_ptr<CameraSet::Gathering> CameraSet::ask_all(const CaptureSettings& settings) {
  const auto gathering = std::make_shared<Gathering>();
  gathering->brought.resize(workers_.size());
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    workers_[i]->thread->post([gathering, i, settings, camera = workers_[i]->camera,
                               description = workers_[i]->description,
                               tally = workers_[i]->tally](TaskProgress& progress) {
      const bool has_turn = !settings.one_at_a_time || gathering->wait_for_turn(i, progress);
      // One that hung comes to this when nobody waits for its frames any more.
      if (!has_turn || gathering->cancelled) return gathering->bring(i, cancelled());
      const auto go_on = [&] {
        progress.step();
        return !gathering->cancelled;
      };
      const auto deadline = steady_clock::now() + settings.deadline;
      gathering->bring(
          i, with_stream(*camera, *description, "the capture", deadline, LateStart::kIsStopped,
                         go_on, [&] { return take_frames(*camera, *tally, settings, go_on); }));
    });
  }
  return gathering;
}

/// What a camera says for having been interrupted is not its fault; with no other fault, those that
/// were not done by the deadline are.
Result<Frames> CameraSet::frames_of(Gathering& gathering) const {
  const std::lock_guard lock(gathering.mutex);
  const bool any_fault = std::any_of(
      gathering.brought.begin(), gathering.brought.end(),
      [](const auto& one) { return one && !*one && one->error().code != ErrorCode::kCancelled; });
  Frames all;
  CaptureFaults faults;
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    auto& brought = gathering.brought[i];
    const std::string& id = workers_[i]->id;
    if (!brought) {
      faults.blame(id, silent_camera(id));
    } else if (brought->has_value()) {
      std::move((*brought)->begin(), (*brought)->end(), std::back_inserter(all));
    } else if (brought->error().code != ErrorCode::kCancelled) {
      faults.blame(id, named_after_camera(id, brought->error()));
    } else if (!any_fault) {
      faults.blame(id, {ErrorCode::kTimeout, Remedy::kRetry,
                        "camera " + id + " did not bring its frames in time",
                        "scan again, or raise capture.deadline_ms"});
    }
  }
  if (const auto error = faults.error()) return tl::make_unexpected(*error);
  return all;
}

void CameraSet::check(const CaptureSettings& settings, ZeroFrames zero_frames,
                      const Report& report) {
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    const Worker& worker = *workers_[i];
    // A camera that hangs is not to find a heap of them.
    if (worker.look->ask(report)) continue;
    worker.thread->post([i, settings, zero_frames, look = worker.look, camera = worker.camera,
                         description = worker.description, tally = worker.tally,
                         id = worker.id](TaskProgress& progress) {
      const Report tell = look->begin();
      const auto go_on = [&] {
        progress.step();
        return true;
      };
      const auto deadline = steady_clock::now() + settings.frame_limit;
      const auto outcome =
          with_stream(*camera, *description, "the look at it", deadline, LateStart::kGoesOn, go_on,
                      [&] { return look_at(*camera, *tally, settings, zero_frames, go_on); });
      outcome ? tell(i, {}) : tell(i, tl::make_unexpected(named_after_camera(id, outcome.error())));
    });
  }
}

void CameraSet::interrupt() const {
  for (const auto& worker : workers_) worker->camera->interrupt();
}

void CameraSet::note_progress(ProgressWatch& watch) const {
  for (const auto& worker : workers_) {
    watch.note("camera " + worker->id, worker->thread->is_busy(), worker->thread->progress());
  }
}

}  // namespace instep
