#include "daemon/station/station.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <memory>
#include <utility>

#include "tests/support/contact_pedal.h"
#include "tests/support/scripted_camera.h"
#include "tests/support/small_station.h"
#include "tests/support/station_on_loop.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using test::ScriptedCamera;
using testing::Contains;
using testing::Not;
using Step = ScriptedCamera::Step;

/// A station with one camera that does what its script says.
class ScriptedStation : public test::StationOnLoop {
 protected:
  /// Neither a look nor a frame has to come in time, and no look comes by itself.
  static Settings patient() {
    auto settings = test::small_station();
    settings.capture.frame_limit = 1h;
    settings.capture.deadline = 1h;
    settings.capture.check_every = 3600s;
    return settings;
  }

  void begin_with(const Settings& settings, std::deque<Step> script,
                  const OpenPedal& opens_pedal = open_pedal) {
    auto owned = std::make_unique<ScriptedCamera>("left", std::move(script));
    camera_ = owned.get();
    const auto cameras = std::make_shared<std::unique_ptr<DepthCamera>>(std::move(owned));
    begin(
        settings,
        [cameras](const Settings&) {
          Devices devices;
          devices.cameras.push_back(std::move(*cameras));
          return OpenedDevices(std::move(devices));
        },
        opens_pedal);
  }

  ScriptedCamera* camera_ = nullptr;
};

/// It was ready before its pedal was open, and a press was lost.
TEST_F(ScriptedStation, IsStartingUntilItsPedalIsOpen) {
  const auto contact = std::make_shared<test::Contact>();
  contact->hang();
  begin_with(patient(), {},
             [contact](const Settings&) { return std::make_unique<test::ContactPedal>(contact); });
  ASSERT_TRUE(loop_.wait_until([&] {
    const auto cameras = station_->status().cameras;
    return contact->holds_a_call() && !cameras.empty() && cameras[0].frames.good > 0;
  }));
  loop_.call([&] { EXPECT_EQ(station_->state(), StationState::kStarting); });
  contact->let_go();
  EXPECT_TRUE(comes_to(StationState::kReady));
}

/// Its pedal was left behind with it, as its closing began when the time for all was used up.
TEST_F(ScriptedStation, ClosesItsPedalThoughACameraHangs) {
  const auto contact = std::make_shared<test::Contact>();
  begin_with(patient(), {Step::kHang},
             [contact](const Settings&) { return std::make_unique<test::ContactPedal>(contact); });
  camera_->wait_until_asked();
  ASSERT_TRUE(loop_.wait_until([&] { return contact->was_read(); }));
  loop_.stop();
  const auto end = std::chrono::steady_clock::now() + 150ms;
  const auto left_behind = station_->end_by(end);
  EXPECT_THAT(left_behind, Contains("a camera"));
  EXPECT_THAT(left_behind, Not(Contains("the pedal")));
  EXPECT_TRUE(contact->wait_until_closed(1));
  camera_->release();
}

/// It refused every scan for the time between two looks, though its camera had just given one.
TEST_F(ScriptedStation, IsReadyAfterAScanThoughALookThatCameBeforeItFails) {
  begin_with(patient(), {Step::kGood, Step::kHang});
  ASSERT_TRUE(comes_to(StationState::kReady));
  loop_.call([&] { station_->reload(patient()); });
  camera_->wait_until_asked(2);
  loop_.call([&] { EXPECT_TRUE(station_->request_scan()); });
  camera_->release();
  StationStatus after;
  ASSERT_TRUE(loop_.wait_until([&] {
    after = station_->status();
    return after.scans == 1;
  }));
  EXPECT_EQ(after.state, StationState::kReady) << after.trouble();
  // For two looks, the scan, and the look that is made again.
  const auto capture = patient().capture;
  camera_->wait_until_asked(2 + capture.warmup_frames + capture.frames_per_camera + 1);
}

/// Its store's trouble was told, which kept nobody from scanning, with a remedy that was no help.
TEST_F(ScriptedStation, SaysThatItIsStartingWhateverElseIsWrong) {
  begin_with(patient(), {Step::kHang});
  camera_->wait_until_asked();
  loop_.call([&] {
    station_->store_failed({ErrorCode::kNoSpace, Remedy::kOperator, "the disk is full", ""});
    const auto asked = station_->request_scan();
    ASSERT_FALSE(asked);
    EXPECT_EQ(asked.error().message, "the station is starting");
    EXPECT_EQ(asked.error().remedy, Remedy::kRetry);
  });
  camera_->release();
}

/// It was told at the start alone, whatever was read later.
TEST_F(ScriptedStation, WarnsOfADeadlineThatIsTooShortForAScanForAsLongAsItIs) {
  auto settings = patient();
  settings.cameras[0].kind = CameraKind::kRecording;
  begin_with(settings, {});
  auto late = settings;
  late.capture.frames_per_camera = 120;
  late.capture.deadline = 1s;
  loop_.call([&] {
    EXPECT_TRUE(station_->status().warnings.empty());
    station_->reload(late);
    ASSERT_EQ(station_->status().warnings.size(), 1U);
    EXPECT_EQ(station_->status().warnings[0].rfind("capture.deadline_ms = 1000 is too short", 0),
              0U);
    station_->reload(settings);
    EXPECT_TRUE(station_->status().warnings.empty());
  });
}

}  // namespace
}  // namespace instep
