#include <gtest/gtest.h>

#include <cerrno>
#include <cstring>

#include "tests/support/v4l2_bench.h"

namespace instep {
namespace {

using namespace std::chrono_literals;

/// Starts, takes some frames, stops. What the first step that failed says.
Result<void> session(DepthCamera& camera) {
  if (auto begun = camera.start(); !begun) return begun;
  for (int i = 0; i < 6; ++i) {
    const auto frame = camera.next_frame(5s);
    if (!frame) {
      camera.stop();
      return tl::make_unexpected(frame.error());
    }
  }
  camera.stop();
  return {};
}

class V4l2CameraFault : public testing::TestWithParam<int> {};

/// The k-th system call fails, for every k of a session: the failure is told, nothing is kept, no
/// call is misused, and the next session is good.
TEST_P(V4l2CameraFault, IsToldAndLeavesNothingBehindAtEveryCall) {
  test::V4l2Bench bench;
  bench.replace({.controls = {{.name = "Laser Power"}}});
  auto settings = bench.settings();
  settings.controls = {{"laser_power", 30}};
  const auto camera = bench.camera(settings);
  ASSERT_TRUE(session(*camera));
  const int calls = bench.kernel().calls();
  ASSERT_GT(calls, 30);
  int told = 0;
  for (int k = 1; k <= calls; ++k) {
    SCOPED_TRACE(testing::Message() << "call " << k << ": " << std::strerror(GetParam()));
    bench.kernel().fail_call(k, GetParam());
    if (const auto outcome = session(*camera); !outcome) {
      ++told;
      EXPECT_NE(outcome.error().remedy, Remedy::kBug);
      EXPECT_FALSE(outcome.error().advice.empty());
    }
    ASSERT_EQ(bench.kernel().held(), 0);
    const auto again = session(*camera);
    ASSERT_TRUE(again) << again.error().line();
  }
  EXPECT_EQ(bench.kernel().misuses(), 0);
  if (GetParam() == EINTR) {
    // Only open() and mmap() take a signal for a failure.
    EXPECT_LE(told, 5);
  } else {
    EXPECT_GT(told, 20);
  }
}

INSTANTIATE_TEST_SUITE_P(All, V4l2CameraFault,
                         testing::Values(EINTR, EIO, ENODEV, EBUSY, EACCES, EMFILE, ENOMEM, EINVAL,
                                         ENOSPC, EPIPE, ETIMEDOUT, ENOTTY),
                         [](const auto& chosen) { return "errno" + std::to_string(chosen.param); });

/// The camera leaves before the k-th call of a session, for every k.
TEST(V4l2CameraUnplug, IsSurvivedAtEveryFrame) {
  for (int frames = 0; frames < 8; ++frames) {
    test::V4l2Bench bench;
    const auto camera = bench.camera();
    ASSERT_TRUE(camera->start());
    for (int i = 0; i < frames; ++i) ASSERT_TRUE(camera->next_frame(5s));
    bench.unplug();
    const auto frame = camera->next_frame(5s);
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().code, ErrorCode::kDeviceGone);
    EXPECT_EQ(frame.error().remedy, Remedy::kReopen);
    camera->stop();
    EXPECT_EQ(bench.kernel().held(), 0);
    bench.plug(3);
    EXPECT_TRUE(session(*camera));
  }
}

}  // namespace
}  // namespace instep
