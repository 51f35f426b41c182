#include "daemon/scan/recorded_capture.h"

#include <gtest/gtest.h>

#include <fstream>

#include "drivers/recording/recording_writer.h"
#include "tests/support/small_recording.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

TEST(RecordedCapture, HoldsAllThatWasRecorded) {
  const test::TemporaryFolder folder;
  test::write_small_recording(folder.path() / "visit");
  const auto capture = read_capture(folder.path() / "visit");
  ASSERT_TRUE(capture) << capture.error().line();
  EXPECT_EQ(capture->platform_height_mm, test::small_header().platform_height_mm);
  EXPECT_EQ(capture->calibration, "recording");
  EXPECT_FALSE(capture->simulated);
  EXPECT_TRUE(capture->truth.empty());
  ASSERT_EQ(capture->cameras.size(), 2U);
  EXPECT_EQ(capture->cameras[0].geometry.id, "left");
  EXPECT_EQ(capture->cameras[1].geometry.id, "right");
  EXPECT_EQ(capture->cameras[1].serial, "0042");
  const auto given = test::small_frames();
  ASSERT_EQ(capture->frames.size(), given.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_EQ(capture->frames[i].camera, given[i].camera);
    EXPECT_EQ(capture->frames[i].raw, given[i].raw);
    EXPECT_EQ(capture->frames[i].device_time, given[i].device_time);
  }
}

TEST(RecordedCapture, KeepsTheTruthOfASimulation) {
  const test::TemporaryFolder folder;
  auto header = test::small_header();
  header.simulated = true;
  header.truth = {{"foot_length", 251.5}};
  header.platform_height_mm.reset();
  {
    auto writer = RecordingWriter::create(folder.path() / "visit", header);
    ASSERT_TRUE(writer) << writer.error().line();
    ASSERT_TRUE(writer->add_frame(test::small_frames().front()));
    ASSERT_TRUE(writer->finish());
  }
  const auto capture = read_capture(folder.path() / "visit");
  ASSERT_TRUE(capture) << capture.error().line();
  EXPECT_TRUE(capture->simulated);
  EXPECT_EQ(capture->truth, header.truth);
  EXPECT_FALSE(capture->platform_height_mm);
}

TEST(RecordedCapture, FailsWhereAnImageOrAllOfItIsLacking) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(read_capture(folder.path() / "nowhere").error().code, ErrorCode::kNotFound);
  test::write_small_recording(folder.path() / "visit");
  std::ofstream(folder.path() / "visit/camera01/000002.png") << "no image";
  EXPECT_EQ(read_capture(folder.path() / "visit").error().code, ErrorCode::kCorruptData);
  std::filesystem::remove(folder.path() / "visit/camera01/000002.png");
  EXPECT_EQ(read_capture(folder.path() / "visit").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace instep
