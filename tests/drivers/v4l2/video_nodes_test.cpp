#include "drivers/v4l2/video_nodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/fake_usb_bus.h"

namespace instep {
namespace {

using testing::HasSubstr;

class VideoNodes : public testing::Test {
 protected:
  Result<std::vector<VideoNode>> find(const UsbAddress& wanted) {
    return find_video_nodes(wanted, {bus_.sysfs(), bus_.dev()});
  }
  static std::string first_name(const Result<std::vector<VideoNode>>& nodes) {
    return nodes ? nodes->front().path.filename().string() : nodes.error().line();
  }

  test::FakeUsbBus bus_;
  test::FakeUsbBus::Camera left_{.port = "2", .serial = "A1", .nodes = {0, 1}};
  test::FakeUsbBus::Camera right_{.port = "4.3", .serial = "B2", .nodes = {2, 10}};
};

TEST_F(VideoNodes, FindsACameraBySerialAndByPlace) {
  bus_.plug(left_);
  bus_.plug(right_);
  EXPECT_EQ(first_name(find({"", "B2"})), "video2");
  EXPECT_EQ(first_name(find({"usb-0000:00:14.0-4.3", ""})), "video2");
  EXPECT_EQ(first_name(find({"usb-0000:00:14.0-2", "A1"})), "video0");
  EXPECT_EQ(find({"", "B2"})->size(), 2U) << "every node of the device, by number";
}

// After a restart or a replug the numbers are others.
TEST_F(VideoNodes, FindsTheSameCameraUnderAnotherNumber) {
  bus_.plug(left_);
  bus_.plug(right_);
  bus_.unplug(left_);
  left_.nodes = {7};
  bus_.plug(left_);
  EXPECT_EQ(first_name(find({"", "A1"})), "video7");
}

// The camera in the left one's socket is not the left one.
TEST_F(VideoNodes, TellsACameraInAnothersPlace) {
  bus_.plug(left_);
  const auto nodes = find({"usb-0000:00:14.0-2", "B2"});
  ASSERT_FALSE(nodes);
  EXPECT_EQ(nodes.error().code, ErrorCode::kDeviceGone);
  EXPECT_THAT(nodes.error().message,
              HasSubstr("there is only \"Depth Camera\", serial A1, at usb-0000:00:14.0-2"));
}

// Some makers give all their cameras the same serial number.
TEST_F(VideoNodes, RefusesASerialThatTwoCamerasHave) {
  right_.serial = left_.serial;
  bus_.plug(left_);
  bus_.plug(right_);
  const auto nodes = find({"", "A1"});
  ASSERT_FALSE(nodes);
  EXPECT_EQ(nodes.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(nodes.error().advice, HasSubstr("bus_path"));
  EXPECT_EQ(first_name(find({"usb-0000:00:14.0-4.3", ""})), "video2");
}

TEST_F(VideoNodes, SaysSoWhenNothingIsPluggedIn) {
  const auto nodes = find({"", "A1"});
  ASSERT_FALSE(nodes);
  EXPECT_THAT(nodes.error().line(), HasSubstr("no camera with serial A1: no camera is plugged in"));
}

TEST_F(VideoNodes, PassesOverWhatIsNoCameraOnTheUsbBus) {
  namespace fs = std::filesystem;
  bus_.plug(left_);
  for (const char* odd : {"video", "videox", "video1x", "radio0", "video99999999999999999999"}) {
    fs::create_directories(bus_.sysfs() / "class/video4linux" / odd);
  }
  fs::create_directory_symlink("nowhere", bus_.sysfs() / "class/video4linux/video5");
  fs::create_directories(bus_.sysfs() / "devices/platform/vivid.0");
  fs::create_directories(bus_.sysfs() / "class/video4linux/video6");
  fs::create_directory_symlink(bus_.sysfs() / "devices/platform/vivid.0",
                               bus_.sysfs() / "class/video4linux/video6/device");
  EXPECT_EQ(list_video_nodes({bus_.sysfs(), bus_.dev()}).size(), 2U);
}

}  // namespace
}  // namespace instep
