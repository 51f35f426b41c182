#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <functional>
#include <thread>

#include "tests/drivers/openni2/openni_fault.h"

/// What goes wrong with real sensors and their driver, made to go wrong behind the stock library.
namespace instep::test {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;
using testing::HasSubstr;

// After a replug the device could not be opened again.
TEST_F(OpenniFault, ReopensAfterReplug) {
  auto camera = streaming_camera();
  for (int round = 0; round < 20; ++round) {
    bus_.unplug("A1");
    EXPECT_EQ(next_failure(*camera).code, ErrorCode::kDeviceGone);
    bus_.plug_in({});
    ASSERT_TRUE(start_at_last(*camera));
    ASSERT_TRUE(camera->next_frame(kLong));
  }
  EXPECT_EQ(child_processes().size(), 1U);
}

// Unplugging within a call crashes it.
TEST_F(OpenniFault, UnplugAtEveryCallBoundary) {
  const std::vector<std::function<void(DepthCamera&)>> calls = {
      [](DepthCamera& camera) { camera.start(); },
      [](DepthCamera& camera) { camera.start(); },
      [](DepthCamera& camera) { camera.next_frame(kLong); },
      [](DepthCamera& camera) { camera.next_frame(0ms); },
      [](DepthCamera& camera) { camera.stop(); },
      [](DepthCamera& camera) { camera.stop(); },
      [](DepthCamera& camera) { camera.start(); },
      [](DepthCamera& camera) { camera.interrupt(); }};
  for (std::size_t boundary = 0; boundary <= calls.size(); ++boundary) {
    bus_.plug_in({});
    const auto camera = bus_.camera();
    for (std::size_t i = 0; i < calls.size(); ++i) {
      if (i == boundary) bus_.unplug("A1");
      EXPECT_LT(time_of([&] { calls[i](*camera); }), kHung) << boundary << " " << i;
    }
    bus_.plug_in({});
    EXPECT_TRUE(frame_at_last(*camera)) << boundary;
  }
  EXPECT_TRUE(child_processes().empty());
}

TEST_F(OpenniFault, UnplugEndsAWaitAtOnce) {  // the library itself only lets it time out
  auto camera = streaming_camera();
  fail_with("stall");
  while (camera->next_frame(100ms)) continue;
  std::thread other([&] {
    std::this_thread::sleep_for(100ms);
    bus_.unplug("A1");
  });
  const auto took = time_of([&] {
    // On a busy machine a frame that was late may come before it stalls.
    const Error error = next_failure(*camera);
    EXPECT_EQ(error.code, ErrorCode::kDeviceGone);
    EXPECT_EQ(error.remedy, Remedy::kReopen);
  });
  other.join();
  EXPECT_LT(took, kHung);
}

// Readers wait for minutes or for ever.
TEST_F(OpenniFault, NeverBlocksLongerThanDeadline) {
  for (const auto* fault : {"stall", "slow"}) {
    auto camera = streaming_camera();
    fail_with(fault);
    for (const int limit_ms : {0, 1, 20, 100, 250}) {
      const auto limit = std::chrono::milliseconds(limit_ms);
      EXPECT_LT(time_of([&] { camera->next_frame(limit); }), limit + kHung) << fault;
    }
    camera.reset();
    bus_.unplug("A1");
  }
}

// A wait cannot be ended by others.
TEST_F(OpenniFault, StopWhileWaitingReturnsWithin1s) {
  auto camera = streaming_camera();
  fail_with("stall");
  while (camera->next_frame(100ms)) continue;
  steady_clock::time_point asked;
  std::thread other([&] {
    std::this_thread::sleep_for(50ms);
    asked = steady_clock::now();
    camera->interrupt();
  });
  EXPECT_EQ(next_failure(*camera).code, ErrorCode::kCancelled);
  camera->stop();
  const auto done = steady_clock::now();
  other.join();
  EXPECT_LT(done - asked, 1s);
}

// Frames stop coming, and to wait longer does not help.
TEST_F(OpenniFault, StallIsATimeoutThatEnds) {
  auto camera = streaming_camera();
  fail_with("stall");
  EXPECT_EQ(next_failure(*camera, 200ms).code, ErrorCode::kTimeout);
  EXPECT_EQ(next_failure(*camera, 200ms).remedy, Remedy::kRetry);
  bus_.set_faults("A1", {});
  EXPECT_TRUE(camera->next_frame(kLong));
}

// Stopping a camera that stalls hangs too.
TEST_F(OpenniFault, HungStopIsAbandoned) {
  auto camera = streaming_camera();
  fail_with("hang-stop");
  std::this_thread::sleep_for(50ms);
  const auto hanging = child_processes();
  camera->stop();
  EXPECT_EQ(child_processes(), hanging) << "it did not wait for the end of that";
  std::this_thread::sleep_for(200ms);  // it hangs by now
  bus_.set_faults("A1", {});
  // Starting waits for the stop to end, in vain, and then begins with a new process.
  ASSERT_TRUE(start_at_last(*camera));
  EXPECT_TRUE(camera->next_frame(kLong));
  EXPECT_EQ(child_processes().size(), 1U);
  EXPECT_NE(child_processes(), hanging);
}

// What hangs in stopping a camera hangs at the end of the program too.
TEST_F(OpenniFault, HungStopDoesNotHoldUpTheEnd) {
  auto camera = streaming_camera();
  fail_with("hang-stop");
  std::this_thread::sleep_for(50ms);
  EXPECT_LT(time_of([&] { camera.reset(); }), kHung);
  EXPECT_TRUE(child_processes().empty());
}

TEST_F(OpenniFault, ResetDuringCapture) {  // the device leaves and is back elsewhere at once
  auto camera = streaming_camera();
  bus_.plug_in({});
  EXPECT_EQ(next_failure(*camera).code, ErrorCode::kDeviceGone);
  ASSERT_TRUE(start_at_last(*camera));
  EXPECT_TRUE(camera->next_frame(kLong));
}

// A device may be away for seconds after it was closed.
TEST_F(OpenniFault, DisappearsAfterClose) {
  auto camera = streaming_camera();
  camera->stop();
  bus_.unplug("A1");
  Result<void> started;
  for (int tries = 0; tries < 3; ++tries) {
    started = failure_at_last(*camera);
    ASSERT_FALSE(started);
    EXPECT_THAT(started.error().code, testing::AnyOf(ErrorCode::kNotFound, ErrorCode::kDeviceGone));
    EXPECT_EQ(started.error().remedy, Remedy::kReopen) << started.error().line();
  }
  EXPECT_THAT(started.error().line(), HasSubstr("A1 is not plugged in"));
  bus_.plug_in({});
  ASSERT_TRUE(start_at_last(*camera));
  EXPECT_TRUE(camera->next_frame(kLong));
}

// Closing does not give the device back, or the second start gets no depth.
TEST_F(OpenniFault, CloseReleasesAndSecondSessionWorks) {
  for (int session = 0; session < 5; ++session) {
    const auto camera = streaming_camera();
    EXPECT_EQ(child_processes().size(), 1U);
  }
  EXPECT_TRUE(child_processes().empty());
}

// Ending crashes or hangs.
TEST_F(OpenniFault, ShutdownInEveryState) {
  const auto expect_an_end = [&](std::unique_ptr<OpenniCamera> camera) {
    EXPECT_LT(time_of([&] { camera.reset(); }), kHung);
    EXPECT_TRUE(child_processes().empty());
  };
  bus_.plug_in({});
  expect_an_end(bus_.camera());
  expect_an_end(streaming_camera());
  auto stopped = streaming_camera();
  stopped->stop();
  expect_an_end(std::move(stopped));
  auto interrupted = streaming_camera();
  interrupted->interrupt();
  expect_an_end(std::move(interrupted));
  auto unplugged = streaming_camera();
  bus_.unplug("A1");
  expect_an_end(std::move(unplugged));
  auto lost = streaming_camera();
  bus_.unplug("A1");
  next_failure(*lost);
  expect_an_end(std::move(lost));
}

TEST_F(OpenniFault, ACrashIsNoticedAndMended) {
  auto camera = streaming_camera();
  fail_with("crash");
  const Error error = next_failure(*camera);
  EXPECT_EQ(error.code, ErrorCode::kIo);
  EXPECT_THAT(error.line(), HasSubstr("signal 6"));
  EXPECT_TRUE(child_processes().empty());
  bus_.set_faults("A1", {});
  ASSERT_TRUE(start_at_last(*camera));
  EXPECT_TRUE(camera->next_frame(kLong));
}

TEST_F(OpenniFault, AHungProcessIsNoticedAndEnded) {
  auto camera = streaming_camera();
  const auto children = child_processes();
  ASSERT_EQ(children.size(), 1U);
  ::kill(children[0], SIGSTOP);
  // Not as a wait that came to its limit.
  const Error error = next_failure(*camera);
  EXPECT_EQ(error.code, ErrorCode::kIo);
  EXPECT_THAT(error.line(), HasSubstr("hung"));
  EXPECT_TRUE(child_processes().empty());
  ASSERT_TRUE(start_at_last(*camera));
  EXPECT_TRUE(camera->next_frame(kLong));
}

TEST_F(OpenniFault, BadFramesAreMarked) {
  const std::vector<std::pair<std::string, FrameStatus>> faults = {
      {"corrupt", FrameStatus::kCorrupt},
      {"wrong-size", FrameStatus::kCorrupt},
      {"short", FrameStatus::kIncomplete}};
  auto camera = streaming_camera();
  for (const auto& [fault, status] : faults) {
    fail_with(fault);
    int good = 0;
    auto frame = camera->next_frame(kLong);
    while (frame && frame->status == FrameStatus::kGood && ++good < 30) {
      frame = camera->next_frame(kLong);
    }
    ASSERT_TRUE(frame) << frame.error().line();
    EXPECT_EQ(frame->status, status) << fault;
    EXPECT_LE(frame->raw.size(), 64U * 48U);
    bus_.set_faults("A1", {});
    for (int bad = 0; bad < 30; ++bad) {
      frame = camera->next_frame(kLong);
      ASSERT_TRUE(frame);
      if (frame->status == FrameStatus::kGood) break;
    }
    EXPECT_EQ(frame->status, FrameStatus::kGood) << fault;
  }
}

TEST_F(OpenniFault, ASensorThatIsTooHotSaysSo) {
  auto camera = streaming_camera();
  fail_with("overheat");
  const Error error = next_failure(*camera);
  EXPECT_EQ(error.remedy, Remedy::kOperator);
  EXPECT_THAT(error.line(), HasSubstr("let it cool down"));
}

TEST_F(OpenniFault, ASensorThatDoesOtherwiseIsRefused) {
  for (const auto* fault : {"keep-mirror", "keep-holes", "keep-mode", "keep-registration"}) {
    bus_.plug_in({.faults = {fault}});
    const auto camera = OpenniCamera::open(bus_.settings());
    ASSERT_FALSE(camera) << fault;
    EXPECT_EQ(camera.error().code, ErrorCode::kUnsupported) << fault;
    EXPECT_EQ(camera.error().remedy, Remedy::kOperator) << fault;
  }
}

}  // namespace
}  // namespace instep::test
