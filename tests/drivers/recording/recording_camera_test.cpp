#include "drivers/recording/recording_camera.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "drivers/recording/recording_reader.h"
#include "tests/support/small_recording.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

class RecordingCameraTest : public testing::Test {
 protected:
  RecordingCameraTest() {
    test::write_small_recording(folder_.path() / "visit");
    recording_ = std::make_shared<Recording>(read_recording(folder_.path() / "visit").value());
  }

  std::unique_ptr<RecordingCamera> camera(RecordingCameraSettings settings = {}) {
    return RecordingCamera::open(recording_, "left", settings).value();
  }

  test::TemporaryFolder folder_;
  std::shared_ptr<const Recording> recording_;
};

TEST_F(RecordingCameraTest, GivesItsFramesInOrderThenFallsSilent) {
  const auto playing = camera();
  ASSERT_TRUE(playing->start());
  for (std::uint64_t i = 0; i < 3; ++i) {
    const auto frame = playing->next_frame(milliseconds(100));
    ASSERT_TRUE(frame) << frame.error().line();
    EXPECT_EQ(frame->sequence, i);
    EXPECT_EQ(frame->camera, "left");
    EXPECT_EQ(frame->raw, test::small_frames()[2 * i].raw);
  }
  const auto asked = steady_clock::now();
  EXPECT_EQ(playing->next_frame(milliseconds(20)).error().code, ErrorCode::kTimeout);
  EXPECT_GE(steady_clock::now() - asked, milliseconds(20));
}

TEST_F(RecordingCameraTest, BeginsAgainAfterStop) {
  const auto playing = camera();
  ASSERT_TRUE(playing->start());
  ASSERT_TRUE(playing->next_frame(milliseconds(100)));
  playing->stop();
  EXPECT_EQ(playing->next_frame(milliseconds(1)).error().code, ErrorCode::kInvalidInput);
  ASSERT_TRUE(playing->start());
  EXPECT_EQ(playing->next_frame(milliseconds(100))->sequence, 0U);
}

TEST_F(RecordingCameraTest, LoopsWithTimeRunningOn) {
  const auto playing = camera({.as_recorded = false, .loop = true});
  ASSERT_TRUE(playing->start());
  auto before = std::chrono::microseconds(0);
  for (std::uint64_t i = 0; i < 10; ++i) {
    const auto frame = playing->next_frame(milliseconds(100));
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->sequence, i);
    EXPECT_EQ(frame->raw, test::small_frames()[2 * (i % 3)].raw);
    EXPECT_GT(frame->device_time, before);
    before = frame->device_time;
  }
}

// However late a busy machine asks for it, no frame comes before its time.
TEST_F(RecordingCameraTest, KeepsThePaceOfTheRecording) {
  const auto playing = camera({.as_recorded = true, .loop = false});
  const auto begin = steady_clock::now();
  ASSERT_TRUE(playing->start());
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(playing->next_frame(std::chrono::seconds(10)));
    EXPECT_GE(steady_clock::now() - begin, i * milliseconds(33)) << "frame " << i;
  }
}

TEST_F(RecordingCameraTest, WaitsNoLongerThanItMayForTheTimeOfAFrame) {
  auto slow = std::make_shared<Recording>(*recording_);
  slow->frames[2].time += std::chrono::hours(1);
  recording_ = slow;
  const auto playing = camera({.as_recorded = true, .loop = false});
  ASSERT_TRUE(playing->start());
  ASSERT_TRUE(playing->next_frame(milliseconds(1)));
  const auto early = playing->next_frame(milliseconds(1));
  ASSERT_FALSE(early);
  EXPECT_EQ(early.error().code, ErrorCode::kTimeout);
}

TEST_F(RecordingCameraTest, StopsWaitingWhenInterrupted) {
  const auto playing = camera({.as_recorded = true, .loop = false});
  ASSERT_TRUE(playing->start());
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(playing->next_frame(milliseconds(500)));
  std::thread other([&] { playing->interrupt(); });
  EXPECT_EQ(playing->next_frame(std::chrono::minutes(1)).error().code, ErrorCode::kCancelled);
  other.join();
  ASSERT_TRUE(playing->start());
  EXPECT_EQ(playing->next_frame(milliseconds(1)).error().code, ErrorCode::kTimeout);
}

TEST_F(RecordingCameraTest, MarksDamagedImagesAndReportsMissingOnes) {
  std::ofstream(recording_->folder / recording_->frames[0].file) << "no PNG";
  std::filesystem::remove(recording_->folder / recording_->frames[2].file);
  const auto playing = camera();
  ASSERT_TRUE(playing->start());
  const auto damaged = playing->next_frame(milliseconds(100));
  ASSERT_TRUE(damaged);
  EXPECT_EQ(damaged->status, FrameStatus::kCorrupt);
  EXPECT_EQ(playing->next_frame(milliseconds(100)).error().code, ErrorCode::kDeviceGone);
}

TEST_F(RecordingCameraTest, IsNotThereWhenTheRecordingHasNoSuchCamera) {
  EXPECT_EQ(RecordingCamera::open(recording_, "third").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace instep
