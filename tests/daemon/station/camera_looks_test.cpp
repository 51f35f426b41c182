#include "daemon/station/camera_looks.h"

#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/loop_thread.h"
#include "tests/support/scripted_camera.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using test::ScriptedCamera;
using Step = ScriptedCamera::Step;

/// Looks at one camera, and what each of them found.
class LooksAtOneCamera : public testing::Test {
 protected:
  ~LooksAtOneCamera() override { loop_.stop(); }

  /// Where they do not end before, no look comes by itself, and none has to be over soon.
  void begin(std::deque<Step> script, std::chrono::milliseconds frame_limit = 1h) {
    auto owned = std::make_unique<ScriptedCamera>("left", std::move(script));
    camera_ = owned.get();
    std::vector<std::unique_ptr<DepthCamera>> all;
    all.push_back(std::move(owned));
    set_ = std::make_shared<CameraSet>(std::move(all));
    CaptureSettings settings;
    settings.warmup_frames = 0;
    settings.frame_limit = frame_limit;
    settings.check_every = 3600s;
    loop_.call([&] {
      looks_.emplace(loop_.loop(), set_, settings, CameraSet::ZeroFrames::kAreFaulty, [this] {
        found_.push_back(looks_->trouble(0) ? looks_->trouble(0)->message : "");
      });
      looks_->look();
    });
  }
  bool has_found(const std::vector<std::string>& each) {
    return loop_.wait_until([&] { return found_ == each; });
  }

  test::LoopThread loop_;
  ScriptedCamera* camera_ = nullptr;
  std::shared_ptr<CameraSet> set_;
  std::optional<CameraLooks> looks_;
  std::vector<std::string> found_;
};

TEST_F(LooksAtOneCamera, ComeAgainSoonWhileItFails) {
  begin({Step::kGone, Step::kGone});
  EXPECT_TRUE(has_found({"camera left: it left", "camera left: it left", ""}));
}

TEST_F(LooksAtOneCamera, TellOfOneThatDoesNotAnswer) {
  begin({Step::kHang}, 1ms);
  EXPECT_TRUE(has_found({"camera left does not answer"}));
  camera_->release();
}

/// What it found passed for the scan's, and kept the next ones waiting.
TEST_F(LooksAtOneCamera, CountForNothingWhereAScanComesBetweenAndAreMadeAgainAfterIt) {
  begin({Step::kHang});
  camera_->wait_until_asked();
  loop_.call([&] { looks_->pause(); });
  camera_->release();
  ASSERT_TRUE(set_->capture({.frames_per_camera = 1, .warmup_frames = 0}, [] { return true; }));
  loop_.call([&] { EXPECT_TRUE(found_.empty()); });
  loop_.call([&] { looks_->resume(false); });
  EXPECT_TRUE(has_found({""}));
}

TEST_F(LooksAtOneCamera, AreMadeAfterAScanIfTheyAreAskedForMeanwhile) {
  begin({});
  ASSERT_TRUE(has_found({""}));
  loop_.call([&] {
    looks_->pause();
    looks_->look();
  });
  ASSERT_TRUE(set_->capture({.frames_per_camera = 1, .warmup_frames = 0}, [] { return true; }));
  loop_.call([&] {
    EXPECT_EQ(found_.size(), 1U) << "the scan needs the cameras";
    looks_->resume(false);
  });
  EXPECT_TRUE(has_found({"", ""}));
}

}  // namespace
}  // namespace instep
