#include "drivers/v4l2/video_modes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

#include "tests/support/fake_video_kernel.h"

namespace instep {
namespace {

using testing::ElementsAre;

class VideoModesTest : public testing::Test {
 protected:
  VideoModesTest() {
    test::FakeVideoDevice device;
    device.formats = {V4L2_PIX_FMT_Z16, V4L2_PIX_FMT_Y16};
    device.sizes = {{640, 480}, {320, 240}};
    kernel_.add(kNode, device);
  }

  void expect_all() {
    const auto modes = list_video_modes(kernel_, kNode);
    ASSERT_TRUE(modes) << modes.error().line();
    ASSERT_EQ(modes->size(), 2U);
    for (const auto& mode : *modes) EXPECT_THAT(mode.sizes, ElementsAre("640x480", "320x240"));
    EXPECT_EQ(modes->front().format, "Z16");
  }

  static constexpr const char* kNode = "/dev/video0";
  test::FakeVideoKernel kernel_;
};

TEST_F(VideoModesTest, AreAllThatTheDriverLists) {
  expect_all();
  EXPECT_EQ(kernel_.held(), 0);
}

// The list ended there.
TEST_F(VideoModesTest, AreAllThoughASignalCutsACallShort) {
  const int before = kernel_.calls();
  expect_all();
  const int calls = kernel_.calls() - before;
  for (int k = 2; k <= calls; ++k) {  // the first opens the node
    SCOPED_TRACE(k);
    kernel_.fail_call(k, EINTR);
    expect_all();
  }
}

// The list ended there, as if the camera had no more to send.
TEST_F(VideoModesTest, AreNoneWhereTheListFailsBeforeItsEnd) {
  const int before = kernel_.calls();
  expect_all();
  const int calls = kernel_.calls() - before;
  for (const int error : {EIO, ENODEV}) {
    for (int k = 2; k < calls; ++k) {  // the first opens the node, and the last closes it
      SCOPED_TRACE(k);
      kernel_.fail_call(k, error);
      const auto modes = list_video_modes(kernel_, kNode);
      ASSERT_FALSE(modes);
      EXPECT_EQ(modes.error().code, error == EIO ? ErrorCode::kIo : ErrorCode::kDeviceGone);
      EXPECT_EQ(kernel_.held(), 0);
    }
  }
}

// Not every driver lists the sizes that it takes.
TEST_F(VideoModesTest, MayBeOfAnySize) {
  kernel_.fail_call(3, ENOTTY);
  const auto modes = list_video_modes(kernel_, kNode);
  ASSERT_TRUE(modes) << modes.error().line();
  EXPECT_TRUE(modes->front().sizes.empty());
}

TEST_F(VideoModesTest, OfNoNodeAreNone) {
  EXPECT_EQ(list_video_modes(kernel_, "/dev/video1").error().code, ErrorCode::kNotFound);
}

// A program without open files to spare was told to plug the camera in again.
TEST_F(VideoModesTest, OfANodeThatCannotBeOpenedTellWhy) {
  const auto error_of = [&](int error) {
    kernel_.fail_call(1, error);
    return list_video_modes(kernel_, kNode).error();
  };
  for (const int error : {EMFILE, ENFILE, ENOMEM}) {
    const Error short_of_files = error_of(error);
    EXPECT_EQ(short_of_files.code, ErrorCode::kIo);
    EXPECT_THAT(short_of_files.line(), testing::HasSubstr("open files"));
    EXPECT_THAT(short_of_files.line(), testing::HasSubstr(kNode));
  }
  EXPECT_EQ(error_of(EBUSY).code, ErrorCode::kBusy);
  EXPECT_EQ(error_of(EACCES).code, ErrorCode::kPermissionDenied);
  for (const int error : {ENOENT, ENODEV, ENXIO}) {
    EXPECT_EQ(error_of(error).code, ErrorCode::kNotFound);
  }
}

}  // namespace
}  // namespace instep
