#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "tests/support/openni_bus.h"

namespace instep::test {

inline constexpr std::chrono::milliseconds kLong{20000};
/// More than a call takes beyond its own limit on a busy machine; one that hangs takes for ever.
inline constexpr auto kHung = kLong / 2;

inline std::chrono::steady_clock::duration time_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::steady_clock::now() - begin;
}

/// The next failure of a streaming camera.
inline Error next_failure(DepthCamera& camera, std::chrono::milliseconds limit = kLong) {
  while (true) {
    const auto frame = camera.next_frame(limit);
    if (!frame) return frame.error();
  }
}

/// Starts as often as it takes, as the daemon does; the last failure if it never works.
inline Result<void> start_at_last(DepthCamera& camera) {
  Result<void> started = camera.start();
  const auto deadline = std::chrono::steady_clock::now() + kLong;
  while (!started && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    started = camera.start();
  }
  return started;
}

/// The same until a frame has come: a camera may have started before it learns that it is gone.
inline Result<DepthFrame> frame_at_last(DepthCamera& camera) {
  Result<DepthFrame> frame;
  for (int tries = 0; tries < 10; ++tries) {
    frame = start_at_last(camera).and_then([&] { return camera.next_frame(kLong); });
    if (frame) break;
  }
  return frame;
}

/// A camera may start before it learns that it is gone, and on a busy machine the search for it may
/// go on after a start has given up.
inline Result<void> failure_at_last(DepthCamera& camera) {
  const auto says_nothing = [](const Result<void>& started) {
    return started || started.error().code == ErrorCode::kTimeout;
  };
  Result<void> started = camera.start();
  const auto deadline = std::chrono::steady_clock::now() + kLong;
  while (says_nothing(started) && std::chrono::steady_clock::now() < deadline) {
    camera.stop();
    started = camera.start();
  }
  return started;
}

/// A bus with a sensor whose driver can be made to fail.
class OpenniFault : public testing::Test {
 protected:
  std::unique_ptr<OpenniCamera> streaming_camera() {
    bus_.plug_in({});
    auto camera = bus_.camera();
    EXPECT_TRUE(start_at_last(*camera));
    EXPECT_TRUE(camera->next_frame(kLong));
    return camera;
  }
  void fail_with(const std::string& fault) { bus_.set_faults("A1", {fault}); }

  OpenniBus bus_;
};

}  // namespace instep::test
