#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "tests/drivers/openni2/openni_fault.h"

/// What goes wrong with real sensors and their driver, made to go wrong behind the stock library:
/// while a sensor is opened and started.
namespace instep::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

// At the start of the daemon the last of several sensors were given up, and had to begin anew.
TEST_F(OpenniFault, IsOpenedThoughItWaitsForItsTurnLongerThanItsOpeningMayTake) {
  bus_.plug_in({});
  // As another process does that opens its sensor.
  Descriptor other(::open(bus_.folder().c_str(), O_RDONLY | O_CLOEXEC));
  ASSERT_EQ(::flock(other.number(), LOCK_EX), 0);
  auto settings = bus_.settings();
  settings.opening_limit = 2000ms;
  auto opening = std::async(std::launch::async, [&] { return OpenniCamera::open(settings); });
  EXPECT_EQ(opening.wait_for(2 * settings.opening_limit), std::future_status::timeout);
  other = Descriptor();
  const auto opened = opening.get();
  EXPECT_TRUE(opened) << opened.error().line();
}

// It was said to be a sensor that hangs, though none was looked at yet.
TEST_F(OpenniFault, IsNotListedAndTheCauseToldWhileAnotherProcessHangsAtOpening) {
  bus_.plug_in({});
  const Descriptor other(::open(bus_.folder().c_str(), O_RDONLY | O_CLOEXEC));
  ASSERT_EQ(::flock(other.number(), LOCK_EX), 0);
  const auto list = list_openni_devices(bus_.program(), kLong);
  ASSERT_FALSE(list);
  EXPECT_THAT(list.error().message, HasSubstr("another instep-openni hangs"));
}

// After a loss of power cameras open, but send nothing.
TEST_F(OpenniFault, OpensButNeverStreams) {
  bus_.plug_in({.faults = {"stall"}});
  const auto camera = bus_.camera();
  ASSERT_TRUE(camera->start());
  EXPECT_EQ(next_failure(*camera, 300ms).code, ErrorCode::kTimeout);
}

TEST_F(OpenniFault, HungStartIsATimeoutAndThenANewProcess) {
  bus_.plug_in({.faults = {"hang-start"}});
  const auto camera = bus_.camera();
  Result<void> started = camera->start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, ErrorCode::kTimeout) << "nobody waits until it is known to hang";
  while (!started && started.error().code == ErrorCode::kTimeout) started = camera->start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, ErrorCode::kIo) << started.error().line();
  bus_.set_faults("A1", {});
  ASSERT_TRUE(start_at_last(*camera));
  EXPECT_TRUE(camera->next_frame(kLong));
}

/// It was stopped for having begun while nobody waited, and started anew, again and again.
TEST_F(OpenniFault, AStartThatTookTooLongServesTheNextCall) {
  bus_.plug_in({.faults = {"slow-start"}});
  const auto camera = bus_.camera();
  const Result<void> started = camera->start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, ErrorCode::kTimeout);
  std::this_thread::sleep_for(500ms);  // it streams by now
  ASSERT_TRUE(camera->start());
  EXPECT_TRUE(camera->next_frame(kLong));
}

/// It streamed on when it had started at last, with nobody to read it.
TEST_F(OpenniFault, AStartThatWasGivenUpIsStopped) {
  bus_.plug_in({.faults = {"slow-start", "hang-stop"}});
  const auto camera = bus_.camera();
  ASSERT_EQ(camera->start().error().code, ErrorCode::kTimeout);
  camera->stop();
  Result<void> next = camera->start();
  while (!next && next.error().code == ErrorCode::kTimeout) next = camera->start();
  ASSERT_FALSE(next) << "that it was told to stop shows in that it hangs there";
  EXPECT_THAT(next.error().line(), HasSubstr("hung while it was stopping"));
  fail_with("slow-start");
  ASSERT_TRUE(frame_at_last(*camera));
  ASSERT_TRUE(start_at_last(*camera));
  camera->stop();
  EXPECT_TRUE(frame_at_last(*camera)) << "and can be started again after a stop";
}

TEST_F(OpenniFault, AnInterruptEndsAStart) {
  bus_.plug_in({.faults = {"hang-start"}});
  const auto camera = bus_.camera();
  // A start forgets what came before it, which on a busy machine is more than the first.
  std::atomic<bool> over = false;
  std::thread other([&] {
    while (!over) {
      std::this_thread::sleep_for(100ms);
      camera->interrupt();
    }
  });
  const Result<void> started = camera->start();
  over = true;
  other.join();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, ErrorCode::kCancelled);
}

TEST_F(OpenniFault, HungOpeningEndsAtItsLimit) {
  bus_.plug_in({.faults = {"hang-open"}});
  auto settings = bus_.settings();
  settings.opening_limit = 1500ms;
  const auto camera = OpenniCamera::open(settings);
  ASSERT_FALSE(camera);
  EXPECT_EQ(camera.error().code, ErrorCode::kIo);
  EXPECT_THAT(camera.error().line(), HasSubstr("hung while it was opening"));
  EXPECT_TRUE(child_processes().empty());
}

TEST_F(OpenniFault, AHungIdleProcessIsReplacedAtStart) {
  auto camera = streaming_camera();
  camera->stop();
  const auto children = child_processes();
  ASSERT_EQ(children.size(), 1U);
  // Not before it has stopped its stream, for that has a limit of its own.
  std::this_thread::sleep_for(200ms);
  ASSERT_TRUE(start_at_last(*camera));
  camera->stop();
  std::this_thread::sleep_for(200ms);
  ASSERT_TRUE(start_at_last(*camera));
  ::kill(child_processes().at(0), SIGSTOP);
  std::this_thread::sleep_for(OpenniChild::kSilenceLimit + 100ms);
  ASSERT_TRUE(start_at_last(*camera));
  EXPECT_TRUE(camera->next_frame(kLong));
  ASSERT_EQ(child_processes().size(), 1U);
  EXPECT_NE(child_processes()[0], children[0]);
}

}  // namespace
}  // namespace instep::test
