#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <mutex>

#include "daemon/loop/progress_watch.h"
#include "daemon/station/camera_set.h"

/// The steps by which the watchdog tells a camera that is slow from one that hangs.
namespace instep {
namespace {

using namespace std::chrono_literals;

/// A camera of which each call takes until the test ends it.
class GatedCamera final : public DepthCamera {
 public:
  enum class Call { kNone, kStart, kFrame, kStop };

  const CameraDescription& description() const override { return description_; }
  Result<void> start() override {
    pass(Call::kStart);
    return {};
  }
  Result<DepthFrame> next_frame(std::chrono::milliseconds) override {
    pass(Call::kFrame);
    return fail(ErrorCode::kTimeout, "no frame came", "");
  }
  void stop() override { pass(Call::kStop); }
  void interrupt() override {}

  /// Ends the call before, and returns once the camera is in this one.
  void go_on_to(Call call) {
    std::unique_lock lock(mutex_);
    if (now_ != call) ended_ = now_;
    changed_.notify_all();
    changed_.wait(lock, [&] { return now_ == call; });
  }
  void end() {
    const std::lock_guard lock(mutex_);
    ended_ = Call::kStop;
    changed_.notify_all();
  }

 private:
  void pass(Call call) {
    std::unique_lock lock(mutex_);
    now_ = call;
    changed_.notify_all();
    changed_.wait(lock, [&] { return ended_ == call; });
  }

  CameraDescription description_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Call now_ = Call::kNone;
  Call ended_ = Call::kNone;
};

bool has_moved(const CameraSet& set, ProgressWatch& watch) {
  set.note_progress(watch);
  return watch.all_moved();
}

// Each call may take as long as its limit, which two of them in a row would not keep to.
TEST(CameraSteps, AreTakenBetweenTheCallsOfACameraThatIsSlowInEach) {
  auto owned = std::make_unique<GatedCamera>();
  GatedCamera& camera = *owned;
  std::vector<std::unique_ptr<DepthCamera>> all;
  all.push_back(std::move(owned));
  CameraSet set(std::move(all));
  ProgressWatch watch;
  set.check({}, CameraSet::ZeroFrames::kAreFaulty, [](std::size_t, const Result<void>&) {});
  using Call = GatedCamera::Call;
  for (const auto call : {Call::kStart, Call::kFrame, Call::kStop}) {
    camera.go_on_to(call);
    EXPECT_TRUE(has_moved(set, watch)) << static_cast<int>(call);
    EXPECT_FALSE(has_moved(set, watch)) << "within the call it takes none";
  }
  camera.end();
  EXPECT_TRUE(set.end_by(std::chrono::steady_clock::now() + 30s));
}

}  // namespace
}  // namespace instep
