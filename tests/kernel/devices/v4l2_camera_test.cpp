#include "drivers/v4l2/v4l2_camera.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "tests/kernel/devices/usb_depth_camera.h"
#include "tests/support/camera_contract.h"

namespace instep::test {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

constexpr int kWidth = 160;
constexpr int kHeight = 120;

/// A value of its own in each pixel of each frame.
std::uint16_t depth_at(std::uint32_t frame, std::size_t pixel, std::uint16_t camera) {
  return static_cast<std::uint16_t>(pixel + 1000 * frame + camera);
}

UsbDepthCamera::Scene counting_scene(std::uint16_t camera = 0) {
  return [camera](std::uint32_t number) {
    std::vector<std::uint16_t> depth(static_cast<std::size_t>(kWidth) * kHeight);
    for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = depth_at(number, i, camera);
    return depth;
  };
}

V4l2Camera::Settings settings_for(const std::string& serial) {
  V4l2Camera::Settings settings;
  settings.geometry.id = "cam" + serial;
  settings.geometry.intrinsics = {kWidth, kHeight, 140.0, 140.0, 79.5, 59.5, {}};
  settings.depth_unit_mm = 1.0;
  settings.address.serial = serial;
  return settings;
}

/// Starts it as soon as the kernel and udev have brought it up.
Result<void> start_when_there(DepthCamera& camera, std::chrono::seconds limit = 15s) {
  const auto deadline = steady_clock::now() + limit;
  for (;;) {
    auto begun = camera.start();
    if (begun || steady_clock::now() > deadline) return begun;
    std::this_thread::sleep_for(20ms);
  }
}

/// Starts when it is there, as the contract's cameras are from the first.
std::unique_ptr<V4l2Camera> camera_that_is_there(const std::string& serial) {
  auto camera = V4l2Camera::create(settings_for(serial)).value();
  if (const auto begun = start_when_there(*camera); !begun) {
    throw std::runtime_error(begun.error().line());
  }
  camera->stop();
  return camera;
}

class KernelBackend {
 public:
  std::unique_ptr<DepthCamera> camera() {
    usb_.plug();
    return camera_that_is_there("0001");
  }
  std::unique_ptr<DepthCamera> silent_camera() {
    usb_.fall_silent(true);
    return camera();
  }

 private:
  UsbDepthCamera usb_{{}, counting_scene()};
};

INSTANTIATE_TYPED_TEST_SUITE_P(V4l2Camera, CameraContract, testing::Types<KernelBackend>);

/// What is true of a frame that came through unharmed.
void expect_depth(const DepthFrame& frame, std::uint16_t camera = 0) {
  ASSERT_EQ(frame.status, FrameStatus::kGood);
  ASSERT_EQ(frame.raw.size(), static_cast<std::size_t>(kWidth) * kHeight);
  const auto number = static_cast<std::uint32_t>(frame.raw[0] - camera) / 1000U;
  for (std::size_t i = 0; i < frame.raw.size(); ++i) {
    ASSERT_EQ(frame.raw[i], depth_at(number, i, camera)) << "pixel " << i << ", frame " << number;
  }
}

TEST(V4l2KernelCamera, GivesEveryPixelOfZ16AndY16) {
  for (const char* format : {"Z16 ", "Y16 "}) {
    UsbDepthCamera usb({.four_letters = format}, counting_scene());
    usb.plug();
    auto settings = settings_for("0001");
    settings.format = format[0] == 'Z' ? DepthFormat::kZ16 : DepthFormat::kY16;
    const auto camera = V4l2Camera::create(settings).value();
    const auto before = std::chrono::floor<std::chrono::microseconds>(steady_clock::now());
    const auto begun = start_when_there(*camera);
    ASSERT_TRUE(begun) << begun.error().line();
    for (int i = 0; i < 15; ++i) {
      const auto frame = camera->next_frame(5s);
      ASSERT_TRUE(frame) << frame.error().line();
      expect_depth(*frame);
      EXPECT_GE(frame->host_time, before) << "stamped on this clock";
      EXPECT_LE(frame->host_time, steady_clock::now());
    }
  }
}

TEST(V4l2KernelCamera, TwoAreToldApartBySerialAndByPlace) {
  UsbDepthCamera left({.port = 0, .serial = "L"}, counting_scene(0));
  UsbDepthCamera right({.port = 3, .serial = "R"}, counting_scene(500));
  right.plug();
  left.plug();
  const auto left_camera = camera_that_is_there("L");
  auto settings = settings_for("R");
  settings.address = {right.bus_path(), ""};
  const auto right_camera = V4l2Camera::create(settings).value();
  ASSERT_TRUE(start_when_there(*left_camera));
  const auto begun = start_when_there(*right_camera);
  ASSERT_TRUE(begun) << begun.error().line();
  for (int i = 0; i < 10; ++i) {
    expect_depth(left_camera->next_frame(5s).value(), 0);
    expect_depth(right_camera->next_frame(5s).value(), 500);
  }
  settings.address = {left.bus_path(), "R"};
  const auto swapped = V4l2Camera::create(settings).value()->start();
  ASSERT_FALSE(swapped);
  EXPECT_EQ(swapped.error().code, ErrorCode::kDeviceGone) << swapped.error().line();
}

/// uvcvideo passes damaged frames of cameras that are plugged in now on, flagged, instead of
/// dropping them.
class PassedOnFrames {
 public:
  PassedOnFrames() { set("1"); }
  ~PassedOnFrames() { set("0"); }
  PassedOnFrames(const PassedOnFrames&) = delete;
  PassedOnFrames& operator=(const PassedOnFrames&) = delete;

 private:
  static void set(const char* value) {
    std::ofstream("/sys/module/uvcvideo/parameters/nodrop") << value;
  }
};

// Damaged or short buffers are taken for frames, or end the stream.
TEST(V4l2KernelCamera, TellsFramesThatTheDriverFlags) {
  const PassedOnFrames passed_on;
  UsbDepthCamera usb({}, counting_scene());
  usb.plug();
  const auto camera = camera_that_is_there("0001");
  const auto begun = camera->start();
  ASSERT_TRUE(begun) << begun.error().line();
  ASSERT_TRUE(camera->next_frame(5s));
  usb.flag_frames(2);
  usb.shorten_frames(3);
  int damaged = 0;
  for (int i = 0; i < 12; ++i) {
    const auto frame = camera->next_frame(5s);
    ASSERT_TRUE(frame) << frame.error().line();
    if (frame->status == FrameStatus::kGood) {
      expect_depth(*frame);
    } else {
      ++damaged;
      EXPECT_TRUE(frame->raw.empty());
    }
  }
  EXPECT_EQ(damaged, 3) << "two of the short ones are flagged as well";
}

class V4l2KernelFault : public testing::Test {
 protected:
  void SetUp() override {
    usb_.plug();
    camera_ = camera_that_is_there("0001");
    const auto begun = camera_->start();
    ASSERT_TRUE(begun) << begun.error().line();
    ASSERT_TRUE(camera_->next_frame(5s));
  }

  UsbDepthCamera usb_{{}, counting_scene()};
  std::unique_ptr<V4l2Camera> camera_;
};

TEST_F(V4l2KernelFault, ShowsFramesThatTheDriverDroppedAsGaps) {
  const auto before = camera_->next_frame(5s).value();
  usb_.flag_frames(3);
  std::uint64_t last = before.sequence;
  std::uint64_t missing = 0;
  for (int i = 0; i < 10; ++i) {
    const auto frame = camera_->next_frame(5s).value();
    expect_depth(frame);
    missing += frame.sequence - last - 1;
    last = frame.sequence;
  }
  EXPECT_EQ(missing, 3U);
}

// Nothing else would ever wake the one who waits.
TEST_F(V4l2KernelFault, GivesUpOnASilentCameraAndGoesOnWithIt) {
  usb_.fall_silent(true);
  Result<DepthFrame> frame = camera_->next_frame(300ms);
  for (int waiting = 0; frame && waiting < 10; ++waiting) frame = camera_->next_frame(300ms);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, ErrorCode::kTimeout);
  usb_.fall_silent(false);
  expect_depth(camera_->next_frame(5s).value());
}

TEST_F(V4l2KernelFault, FailsToStartWhileTheNegotiationIsRefused) {
  camera_->stop();
  usb_.stall_probes(1000);
  const auto refused = camera_->start();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().remedy, Remedy::kBug) << refused.error().line();
  usb_.stall_probes(0);
  const auto begun = camera_->start();
  ASSERT_TRUE(begun) << begun.error().line();
  expect_depth(camera_->next_frame(5s).value());
}

// Waiting never ends after an unplug; what is kept of the dead device hinders its return.
TEST_F(V4l2KernelFault, TellsThatItWasUnpluggedAndServesAgain) {
  usb_.fall_silent(true);
  std::thread hand([&] { usb_.unplug(); });
  constexpr auto kLong = 20s;
  const auto begin = steady_clock::now();
  auto frame = camera_->next_frame(kLong);
  while (frame) frame = camera_->next_frame(kLong);
  hand.join();
  EXPECT_EQ(frame.error().code, ErrorCode::kDeviceGone) << frame.error().line();
  EXPECT_LT(steady_clock::now() - begin, kLong);
  usb_.fall_silent(false);
  usb_.plug();
  const auto begun = start_when_there(*camera_);
  ASSERT_TRUE(begun) << begun.error().line();
  expect_depth(camera_->next_frame(5s).value());
}

}  // namespace
}  // namespace instep::test
