#include "drivers/v4l2/v4l2_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <thread>

#include "tests/support/v4l2_bench.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using test::FakeVideoDevice;
using testing::HasSubstr;
using Image = FakeVideoDevice::Image;

class V4l2CameraTest : public testing::Test {
 protected:
  /// A started camera on a device that sends `images` first.
  std::unique_ptr<V4l2Camera> started(std::deque<Image> images) {
    bench_.kernel().change(bench_.node(), [&](auto& device) { device.images = std::move(images); });
    auto camera = bench_.camera();
    EXPECT_TRUE(camera->start());
    return camera;
  }
  static DepthFrame next(DepthCamera& camera) { return camera.next_frame(5s).value(); }
  Error start_error(FakeVideoDevice device) {
    bench_.replace(std::move(device));
    const auto camera = bench_.camera();
    const auto outcome = camera->start();
    return outcome ? Error{} : outcome.error();
  }

  test::V4l2Bench bench_;
};

TEST_F(V4l2CameraTest, GivesTheDepthOfEachFormat) {
  const std::pair<DepthFormat, std::uint32_t> formats[] = {{DepthFormat::kZ16, V4L2_PIX_FMT_Z16},
                                                           {DepthFormat::kY16, V4L2_PIX_FMT_Y16},
                                                           {DepthFormat::kInzi, V4L2_PIX_FMT_INZI}};
  for (const auto& [format, code] : formats) {
    FakeVideoDevice device;
    device.formats = {V4L2_PIX_FMT_YUYV, code};
    device.padding = format == DepthFormat::kInzi ? 0 : 32;
    bench_.replace(device);
    auto settings = bench_.settings();
    settings.format = format;
    const auto camera = bench_.camera(settings);
    ASSERT_TRUE(camera->start());
    const auto frame = next(*camera);
    ASSERT_EQ(frame.raw.size(), 64U * 48U);
    EXPECT_DOUBLE_EQ(frame.depth_unit_mm, 0.125);
    for (std::size_t i = 0; i < frame.raw.size(); ++i) {
      ASSERT_EQ(frame.raw[i], i + frame.sequence) << to_string_of_four(code) << " pixel " << i;
    }
  }
}

TEST_F(V4l2CameraTest, RefusesToGuessWhatV4l2DoesNotSay) {
  const auto refused = [&](auto change) {
    auto settings = bench_.settings();
    change(settings);
    const auto camera = V4l2Camera::create(settings, bench_.kernel());
    return !camera && camera.error().code == ErrorCode::kInvalidInput;
  };
  EXPECT_TRUE(refused([](auto& settings) { settings.depth_unit_mm = 0.0; }));
  EXPECT_TRUE(refused([](auto& settings) { settings.depth_unit_mm = 0.0005; }));
  EXPECT_TRUE(refused([](auto& settings) { settings.depth_unit_mm = std::nan(""); }));
  EXPECT_TRUE(refused([](auto& settings) { settings.geometry.intrinsics = {}; }));
  EXPECT_TRUE(refused([](auto& settings) { settings.address = {}; }));
}

// What is kept of the dead device makes its return fail for ever.
TEST_F(V4l2CameraTest, ReopensUnderAnotherNumberAfterReplug) {
  const auto camera = bench_.camera();
  for (int round = 0; round < 100; ++round) {
    ASSERT_TRUE(camera->start()) << "round " << round;
    ASSERT_EQ(next(*camera).status, FrameStatus::kGood);
    bench_.unplug();
    const auto frame = camera->next_frame(5s);
    ASSERT_FALSE(frame);
    ASSERT_EQ(frame.error().code, ErrorCode::kDeviceGone) << frame.error().line();
    ASSERT_EQ(bench_.kernel().held(), 0) << "after the camera left";
    const auto away = camera->start();
    ASSERT_FALSE(away);
    ASSERT_EQ(away.error().code, ErrorCode::kDeviceGone);
    bench_.plug(round % 7);
  }
  EXPECT_EQ(bench_.kernel().misuses(), 0);
}

// A mapping that is left keeps the node busy even behind a closed descriptor.
TEST_F(V4l2CameraTest, GivesEverythingBackOnStop) {
  const auto camera = bench_.camera();
  const auto other = bench_.camera();
  for (int round = 0; round < 100; ++round) {
    ASSERT_TRUE(camera->start());
    const auto busy = other->start();
    ASSERT_FALSE(busy);
    EXPECT_EQ(busy.error().code, ErrorCode::kBusy);
    next(*camera);
    camera->stop();
    ASSERT_EQ(bench_.kernel().held(), 0) << "round " << round;
  }
  EXPECT_TRUE(other->start());
  EXPECT_EQ(bench_.kernel().misuses(), 0);
}

// Nothing else would ever wake the one who waits.
TEST_F(V4l2CameraTest, WakesAWaiterWhenTheCameraIsUnplugged) {
  bench_.kernel().change(bench_.node(), [](auto& device) { device.silent = true; });
  const auto camera = bench_.camera();
  ASSERT_TRUE(camera->start());
  std::thread hand([&] { bench_.unplug(); });
  constexpr auto kLong = 20s;
  const auto begin = std::chrono::steady_clock::now();
  const auto frame = camera->next_frame(kLong);
  hand.join();
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, ErrorCode::kDeviceGone);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, kLong);
}

// Buffers that the kernel still has must not be lent to it again.
TEST_F(V4l2CameraTest, LendsOnlyBuffersThatItTookAfterTimeouts) {
  bench_.kernel().change(bench_.node(), [](auto& device) { device.silent = true; });
  const auto camera = bench_.camera();
  ASSERT_TRUE(camera->start());
  for (int i = 0; i < 10; ++i) ASSERT_FALSE(camera->next_frame(0ms));
  bench_.kernel().change(bench_.node(), [](auto& device) { device.silent = false; });
  for (int i = 0; i < 10; ++i) ASSERT_EQ(next(*camera).status, FrameStatus::kGood);
  EXPECT_EQ(bench_.kernel().misuses(), 0);
}

// Damaged buffers are told as such, have no pixels, and do not end the stream.
TEST_F(V4l2CameraTest, TellsDamagedBuffersAndUsesNoneOfThem) {
  const auto camera = started(
      {Image{.flagged = true}, Image{.bytes = 0}, Image{.bytes = 64 * 48 * 2 - 1}, Image{}});
  const FrameStatus expected[] = {FrameStatus::kCorrupt, FrameStatus::kIncomplete,
                                  FrameStatus::kIncomplete, FrameStatus::kGood, FrameStatus::kGood};
  for (const auto status : expected) {
    const auto frame = next(*camera);
    EXPECT_EQ(frame.status, status);
    EXPECT_EQ(frame.raw.empty(), status != FrameStatus::kGood);
  }
  EXPECT_EQ(bench_.kernel().misuses(), 0);
}

TEST_F(V4l2CameraTest, TellsStaleBuffers) {
  const auto camera = started({Image{.sequence = 77, .stamp = std::chrono::microseconds(1)}});
  EXPECT_EQ(next(*camera).status, FrameStatus::kStale);
  EXPECT_EQ(next(*camera).status, FrameStatus::kGood);
}

TEST_F(V4l2CameraTest, ShowsLostFramesInTheSequence) {
  const auto camera = started({Image{}, Image{.lost_before = 3}});
  const auto first = next(*camera);
  EXPECT_EQ(next(*camera).sequence, first.sequence + 4);
}

// Stamps that are not on the clock of this machine, as the buffer's flags say.
TEST_F(V4l2CameraTest, HonoursTheFlagOfTheClock) {
  const auto before = std::chrono::steady_clock::now();
  const std::chrono::microseconds stamp(42);
  const auto camera = started({Image{.stamp = stamp, .clock = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN},
                               Image{.stamp = stamp, .clock = V4L2_BUF_FLAG_TIMESTAMP_COPY}});
  for (int i = 0; i < 2; ++i) {
    const auto frame = next(*camera);
    EXPECT_EQ(frame.status, FrameStatus::kGood);
    EXPECT_GE(frame.host_time, std::chrono::floor<std::chrono::microseconds>(before));
    EXPECT_LE(frame.host_time, std::chrono::steady_clock::now());
  }
}

// The kernel's words for it are "No space left on device".
TEST_F(V4l2CameraTest, ReportsAFullUsbBusAsSuch) {
  const auto error = start_error({.stream_on_error = ENOSPC});
  EXPECT_EQ(error.code, ErrorCode::kNoBandwidth);
  EXPECT_EQ(error.remedy, Remedy::kOperator);
  EXPECT_THAT(error.line(), HasSubstr("USB"));
  EXPECT_EQ(bench_.kernel().held(), 0);
}

// Drivers change what they do not like, and say nothing.
TEST_F(V4l2CameraTest, RefusesAFormatThatTheDriverChanged) {
  EXPECT_EQ(start_error({.other_code = V4L2_PIX_FMT_YUYV}).code, ErrorCode::kUnsupported);
  EXPECT_EQ(start_error({.other_width = 320}).code, ErrorCode::kUnsupported);
  EXPECT_EQ(start_error({.other_line = 64}).code, ErrorCode::kUnsupported);
  EXPECT_EQ(start_error({.other_image_size = 100}).code, ErrorCode::kUnsupported);
  EXPECT_THAT(start_error({.formats = {V4L2_PIX_FMT_YUYV}}).message, HasSubstr("only: YUYV"));
  EXPECT_EQ(bench_.kernel().held(), 0);
}

TEST_F(V4l2CameraTest, FindsTheNodeThatStreamsDepthAmongThoseOfItsDevice) {
  bench_.unplug();
  bench_.bus().plug({.port = "3", .serial = "A1", .nodes = {4, 5, 6}});
  const auto path = [&](const char* name) { return (bench_.bus().dev() / name).string(); };
  bench_.kernel().add(path("video4"), {.formats = {V4L2_PIX_FMT_YUYV}});
  bench_.kernel().add(path("video5"), {.capabilities = V4L2_CAP_META_CAPTURE});
  bench_.kernel().add(path("video6"), {});
  const auto camera = bench_.camera();
  const auto begun = camera->start();
  ASSERT_TRUE(begun) << begun.error().line();
  EXPECT_EQ(next(*camera).status, FrameStatus::kGood);
}

// What is wrong with the node that streams depth is told, not that the others do not stream it.
TEST_F(V4l2CameraTest, SaysWhatIsWrongWithTheNodeThatStreamsDepth) {
  bench_.unplug();
  bench_.bus().plug({.port = "3", .serial = "A1", .nodes = {4, 5, 6}});
  const auto path = [&](const char* name) { return (bench_.bus().dev() / name).string(); };
  bench_.kernel().add(path("video4"), {.formats = {V4L2_PIX_FMT_YUYV}});
  bench_.kernel().add(path("video5"), {.other_width = 320});
  bench_.kernel().add(path("video6"), {.capabilities = V4L2_CAP_META_CAPTURE});
  const auto begun = bench_.camera()->start();
  ASSERT_FALSE(begun);
  EXPECT_THAT(begun.error().message, HasSubstr("it sends Z16 320x48, not Z16 64x48"));
}

TEST_F(V4l2CameraTest, SetsControlsByNameInTheirOrder) {
  bench_.replace(
      {.controls = {
           {.name = "Auto Exposure"},
           {.name = "Exposure Time, Absolute", .maximum = 10000, .locked_by = "Auto Exposure"},
           {.name = "Laser Power", .maximum = 360, .step = 30}}});
  auto settings = bench_.settings();
  settings.controls = {{"auto_exposure", 1}, {"exposure_time_absolute", 85}, {"laser_power", 150}};
  ASSERT_TRUE(bench_.camera(settings)->start());
  bench_.kernel().change(bench_.node(), [](const auto& device) {
    EXPECT_EQ(device.controls[0].value, 1);
    EXPECT_EQ(device.controls[1].value, 85);
    EXPECT_EQ(device.controls[2].value, 150);
  });
}

TEST_F(V4l2CameraTest, SaysWhichControlCannotBeSet) {
  const FakeVideoDevice device{.controls = {{.name = "Auto Exposure"},
                                            {.name = "Exposure", .locked_by = "Auto Exposure"},
                                            {.name = "Laser Power", .maximum = 360, .step = 30}}};
  const auto refusal = [&](const CameraControl& control) {
    bench_.replace(device);
    auto settings = bench_.settings();
    settings.controls = {control};
    const auto begun = bench_.camera(settings)->start();
    return begun ? std::string() : begun.error().line();
  };
  EXPECT_THAT(refusal({"lazer_power", 30}),
              HasSubstr("only: auto_exposure, exposure, laser_power"));
  EXPECT_THAT(refusal({"laser_power", 361}), HasSubstr("361 is outside 0 to 360"));
  EXPECT_THAT(refusal({"laser_power", 100}), HasSubstr("took 90 instead of 100"));
  EXPECT_THAT(refusal({"exposure", 50}), HasSubstr("took 0 instead of 50"));
  EXPECT_EQ(bench_.kernel().held(), 0);
}

TEST(V4l2CameraInASocket, TellsWhichUnitIsInItsSocketAndTakesNoOtherForIt) {
  test::V4l2Bench bench;
  auto settings = bench.settings();
  const auto nodes = list_video_nodes(settings.folders);
  ASSERT_EQ(nodes.size(), 1U);
  settings.address = {nodes.front().device.address.bus_path, ""};
  const auto camera = bench.camera(settings);
  EXPECT_EQ(camera->description().serial, "A1");
  ASSERT_TRUE(camera->start());
  camera->stop();
  bench.unplug();
  EXPECT_EQ(bench.camera(settings)->description().serial, "") << "nothing is there";
  bench.bus().plug({.port = "2", .serial = "B2", .nodes = {0}});
  bench.kernel().add(bench.node(), {});
  const auto started = camera->start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, ErrorCode::kUnsupported);
  const auto fresh = bench.camera(settings);
  EXPECT_EQ(fresh->description().serial, "B2");
  EXPECT_TRUE(fresh->start());
}

// Whether its calibration is that of another unit could not be told until a restart.
TEST(V4l2CameraInASocket, TellsItsSerialNumberOnceItHasComeAndTakesNoOtherUnitFromThen) {
  test::V4l2Bench bench;
  auto settings = bench.settings();
  settings.address = {list_video_nodes(settings.folders).at(0).device.address.bus_path, ""};
  bench.unplug();
  const auto camera = bench.camera(settings);
  EXPECT_EQ(camera->description().serial, "");
  bench.plug(0);
  ASSERT_TRUE(camera->start());
  EXPECT_EQ(camera->description().serial, "A1");
  camera->stop();
  bench.unplug();
  bench.bus().plug({.port = "2", .serial = "B2", .nodes = {0}});
  bench.kernel().add(bench.node(), {});
  const auto started = camera->start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace instep
