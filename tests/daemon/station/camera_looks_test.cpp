#include "daemon/station/camera_looks.h"

#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/loop_thread.h"
#include "tests/support/scripted_camera.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using test::ScriptedCamera;
using Step = ScriptedCamera::Step;

/// Looks at cameras, and what each of them found at the first.
class LooksAtOneCamera : public testing::Test {
 protected:
  ~LooksAtOneCamera() override { loop_.stop(); }

  /// Where they do not end before, no look comes by itself, and none has to be over soon.
  void begin(std::deque<Step> script, std::chrono::milliseconds frame_limit = 1h) {
    begin_all({std::move(script)}, frame_limit);
  }

  /// The last of two is called right.
  void begin_all(std::vector<std::deque<Step>> scripts, std::chrono::milliseconds frame_limit) {
    std::vector<std::unique_ptr<DepthCamera>> all;
    for (auto& script : scripts) {
      auto owned =
          std::make_unique<ScriptedCamera>(all.empty() ? "left" : "right", std::move(script));
      camera_ = owned.get();
      all.push_back(std::move(owned));
    }
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

/// What one of them had answered left a trouble beside a station that is ready.
TEST_F(LooksAtOneCamera, ThatAreGivenUpCountForNothingOfThoseThatHadAnswered) {
  begin_all({{Step::kGone}, {Step::kHang}}, 1h);
  camera_->wait_until_asked();
  for (int i = 0; i < 100; ++i) {
    loop_.call([&] { EXPECT_TRUE(looks_->all_answer()); });
    std::this_thread::sleep_for(1ms);
  }
  loop_.call([&] {
    looks_->pause();
    EXPECT_TRUE(looks_->all_answer());
  });
  camera_->release();
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
