#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "drivers/recording/depth_png.h"
#include "drivers/recording/recording_json.h"
#include "drivers/recording/recording_reader.h"
#include "drivers/recording/recording_writer.h"
#include "tests/support/small_recording.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

TEST(Recording, ComesBackBitByBit) {
  const test::TemporaryFolder folder;
  const auto place = folder.path() / "visit";
  test::write_small_recording(place);
  const auto read = read_recording(place);
  ASSERT_TRUE(read) << read.error().line();
  const auto header = test::small_header();
  ASSERT_EQ(read->cameras.size(), 2U);
  EXPECT_EQ(read->platform_height_mm, header.platform_height_mm);
  EXPECT_FALSE(read->simulated);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& camera = read->cameras[i];
    EXPECT_EQ(camera.geometry.id, header.cameras[i].geometry.id);
    EXPECT_EQ(camera.serial, "0042");
    EXPECT_EQ(camera.depth_unit_mm, 0.1);
    EXPECT_EQ(camera.geometry.intrinsics.distortion,
              header.cameras[i].geometry.intrinsics.distortion);
    EXPECT_TRUE(camera.geometry.station_from_camera.isApprox(
        header.cameras[i].geometry.station_from_camera, 1e-15));
  }
  const auto frames = read_recorded_frames(*read);
  ASSERT_TRUE(frames) << frames.error().line();
  const auto written = test::small_frames();
  ASSERT_EQ(frames->size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ((*frames)[i].raw, written[i].raw);
    EXPECT_EQ((*frames)[i].camera, written[i].camera);
    EXPECT_EQ((*frames)[i].sequence, written[i].sequence);
    EXPECT_EQ((*frames)[i].device_time, written[i].device_time);
    EXPECT_EQ(read_recorded_frame(*read, i, 7)->sequence, 7U);
  }
}

TEST(Recording, IsTheSameBytesEachTime) {
  const test::TemporaryFolder folder;
  test::write_small_recording(folder.path() / "a");
  test::write_small_recording(folder.path() / "b");
  EXPECT_EQ(text_of(folder.path() / "a/recording.json"),
            text_of(folder.path() / "b/recording.json"));
}

TEST(Recording, KeepsItsTruth) {
  auto recording = test::small_header();
  recording.simulated = true;
  recording.truth = {{"ball_girth", 245.123456789012345}};
  recording.frames = {{"left", "a.png", std::chrono::microseconds(5)}};
  const auto again = recording_from_json(recording_to_json(recording), "recording.json");
  ASSERT_TRUE(again) << again.error().line();
  EXPECT_TRUE(again->simulated);
  EXPECT_TRUE(again->cameras[0].simulated);
  EXPECT_EQ(again->truth, recording.truth);
}

/// One fault put into a sound recording.json, and what the error must say.
struct JsonFault {
  const char* name;
  std::function<void(json&)> damage;
  const char* said;
};

class RecordingFault : public testing::TestWithParam<JsonFault> {};

TEST_P(RecordingFault, IsToldWithTheFileAndARemedy) {
  auto recording = test::small_header();
  recording.frames = {{"left", "a/0.png", std::chrono::microseconds(5)},
                      {"right", "b/0.png", std::chrono::microseconds(5)}};
  json root = json::parse(recording_to_json(recording));
  GetParam().damage(root);
  const auto read = recording_from_json(root.dump(), "/visit/recording.json");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("/visit/recording.json"), std::string::npos);
  EXPECT_NE(read.error().line().find(GetParam().said), std::string::npos) << read.error().line();
  EXPECT_FALSE(read.error().advice.empty());
}

INSTANTIATE_TEST_SUITE_P(
    All, RecordingFault,
    testing::Values(
        JsonFault{"List", [](json& r) { r = json::array(); }, "no recording"},
        JsonFault{"Format", [](json& r) { r["format"] = "x"; }, "instep-recording"},
        JsonFault{"Version", [](json& r) { r["version"] = 2; }, "newer program"},
        JsonFault{"VersionText", [](json& r) { r["version"] = "1"; }, "whole number"},
        JsonFault{"NoCameras", [](json& r) { r.erase("cameras"); }, "\"cameras\" is missing"},
        JsonFault{"EmptyCameras", [](json& r) { r["cameras"] = json::array(); }, "1 to 64"},
        JsonFault{"ManyCameras", [](json& r) { r["cameras"] = json::array_t(65, r["cameras"][0]); },
                  "1 to 64"},
        JsonFault{"ManyFrames",
                  [](json& r) { r["frames"] = json::array_t(100001, r["frames"][0]); }, "100000"},
        JsonFault{"CameraIsNumber", [](json& r) { r["cameras"][1] = 5; }, "camera 1"},
        JsonFault{"NoId", [](json& r) { r["cameras"][0].erase("id"); }, "\"id\" is missing"},
        JsonFault{"EmptyId", [](json& r) { r["cameras"][0]["id"] = ""; }, "printable"},
        JsonFault{"SameId", [](json& r) { r["cameras"][1]["id"] = "left"; }, "two cameras"},
        JsonFault{"WidthText", [](json& r) { r["cameras"][0]["width"] = "64"; }, "whole number"},
        JsonFault{"WidthHuge", [](json& r) { r["cameras"][0]["width"] = 1e18; }, "width"},
        JsonFault{"WidthUnsigned",
                  [](json& r) { r["cameras"][0]["width"] = 18446744073709551615ULL; }, "8192"},
        JsonFault{"WidthSmall", [](json& r) { r["cameras"][0]["width"] = 3; }, "camera 0"},
        JsonFault{"UnitZero", [](json& r) { r["cameras"][0]["depth_unit_mm"] = 0; }, "between"},
        // No frame of it would be taken.
        JsonFault{"UnitTiny", [](json& r) { r["cameras"][0]["depth_unit_mm"] = 5e-4; }, "between"},
        JsonFault{"UnitHuge", [](json& r) { r["cameras"][0]["depth_unit_mm"] = 1e30; }, "between"},
        JsonFault{"FocalNull", [](json& r) { r["cameras"][0]["fx"] = nullptr; }, "a number"},
        JsonFault{"FocalHuge", [](json& r) { r["cameras"][0]["fx"] = 1e30; }, "camera 0"},
        JsonFault{"FocalNegative", [](json& r) { r["cameras"][0]["fy"] = -70; }, "camera 0"},
        JsonFault{"CentreFar", [](json& r) { r["cameras"][0]["cx"] = 1e30; }, "camera 0"},
        JsonFault{"Distortion",
                  [](json& r) {
                    r["cameras"][0]["distortion"] = {1, 2};
                  },
                  "5 numbers"},
        JsonFault{"DistortionHuge",
                  [](json& r) {
                    r["cameras"][0]["distortion"] = {1e30, 0, 0, 0, 0};
                  },
                  "camera 0"},
        JsonFault{"PoseShort", [](json& r) { r["cameras"][0]["station_from_camera"].erase(0); },
                  "16 numbers"},
        JsonFault{"PoseScaled", [](json& r) { r["cameras"][0]["station_from_camera"][0] = 2.0; },
                  "rigid"},
        JsonFault{"PoseFar", [](json& r) { r["cameras"][0]["station_from_camera"][3] = 1e6; },
                  "100 m"},
        JsonFault{"NoFrames", [](json& r) { r["frames"] = json::array(); }, "frames"},
        JsonFault{"FrameCamera", [](json& r) { r["frames"][1]["camera"] = "third"; },
                  "no camera of the recording"},
        JsonFault{"FrameUp", [](json& r) { r["frames"][0]["file"] = "a/../../x.png"; }, "inside"},
        JsonFault{"FrameRoot", [](json& r) { r["frames"][0]["file"] = "/etc/passwd"; }, "inside"},
        JsonFault{"FrameEmpty", [](json& r) { r["frames"][0]["file"] = ""; }, "inside"},
        JsonFault{"FrameNul", [](json& r) { r["frames"][0]["file"] = std::string("a\0b", 3); },
                  "inside"},
        JsonFault{"TimeNegative", [](json& r) { r["frames"][0]["time_us"] = -1; }, "time_us"},
        JsonFault{"TimeFraction", [](json& r) { r["frames"][0]["time_us"] = 0.5; }, "time_us"},
        JsonFault{"TimeBackwards",
                  [](json& r) {
                    r["frames"][1]["camera"] = "left";
                    r["frames"][1]["time_us"] = 1;
                  },
                  "older"},
        JsonFault{"Platform", [](json& r) { r["platform"] = 3; }, "platform"},
        JsonFault{"PlatformHuge", [](json& r) { r["platform"]["height_mm"] = 1e30; }, "between"},
        JsonFault{"Simulated", [](json& r) { r["simulated"] = 1; }, "true or false"},
        JsonFault{"TruthList",
                  [](json& r) {
                    r["truth"] = {1, 2};
                  },
                  "truth"},
        JsonFault{"TruthText",
                  [](json& r) {
                    r["truth"] = {{"a", "b"}};
                  },
                  "truth"},
        JsonFault{"TruthReal",
                  [](json& r) {
                    r["truth"] = {{"a", 1}};
                  },
                  "simulated"}),
    [](const auto& fault) { return std::string(fault.param.name); });

TEST(RecordingReader, TellsWhereTheJsonBreaks) {
  for (const char* text : {"", "{", "{\"format\": NaN}", "[1e999]", "\xff\xfe", "{}x"}) {
    const auto read = recording_from_json(text, "recording.json");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::kCorruptData);
    EXPECT_EQ(read.error().line().find('\n'), std::string::npos);
  }
}

TEST(RecordingReader, SurvivesDeepNesting) {
  EXPECT_FALSE(recording_from_json(std::string(1000000, '['), "recording.json"));
}

TEST(RecordingReader, TellsAMissingFolderAndAFile) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(read_recording(folder.path() / "none").error().code, ErrorCode::kNotFound);
  std::ofstream(folder.path() / "file") << "x";
  const auto read = read_recording(folder.path() / "file");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().line().find("folder that holds recording.json"), std::string::npos);
}

TEST(RecordingReader, RefusesImagesOfAnotherSize) {
  const test::TemporaryFolder folder;
  const auto place = folder.path() / "visit";
  test::write_small_recording(place);
  const auto read = read_recording(place);
  ASSERT_TRUE(read);
  std::ofstream(place / read->frames[0].file, std::ios::binary)
      << *encode_depth_png({32, 32, std::vector<std::uint16_t>(1024)});
  const auto frame = read_recorded_frame(*read, 0, 0);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, ErrorCode::kCorruptData);
  EXPECT_NE(frame.error().message.find("32 x 32"), std::string::npos);
}

TEST(RecordingReader, RefusesLinksThatLeadOut) {
  const test::TemporaryFolder folder;
  const auto place = folder.path() / "visit";
  test::write_small_recording(place);
  const auto read = read_recording(place);
  ASSERT_TRUE(read);
  const auto image = place / read->frames[0].file;
  fs::rename(image, folder.path() / "outside.png");
  fs::create_symlink(folder.path() / "outside.png", image);
  const auto frame = read_recorded_frame(*read, 0, 0);
  ASSERT_FALSE(frame);
  EXPECT_NE(frame.error().message.find("leads out"), std::string::npos);
}

TEST(RecordingWriter, LeavesNothingBehindWhenNotFinished) {
  const test::TemporaryFolder folder;
  const auto place = folder.path() / "visit";
  {
    auto writer = RecordingWriter::create(place, test::small_header());
    ASSERT_TRUE(writer) << writer.error().line();
    ASSERT_TRUE(writer->add_frame(test::small_frames()[0]));
    EXPECT_FALSE(fs::exists(place / kRecordingFileName));
  }
  EXPECT_FALSE(fs::exists(place));
}

TEST(RecordingWriter, ClearsWhatASuddenEndHasLeft) {
  const test::TemporaryFolder folder;
  const auto place = folder.path() / "visit";
  fs::create_directories(place / ".unfinished" / "camera07");
  std::ofstream(place / ".unfinished" / "camera07" / "000000.png") << "half";
  test::write_small_recording(place);
  EXPECT_TRUE(read_recording(place));
  EXPECT_FALSE(fs::exists(place / ".unfinished"));
  EXPECT_FALSE(fs::exists(place / "camera07"));
}

TEST(RecordingWriter, LeavesToAnotherWhatItStillWrites) {
  const test::TemporaryFolder folder;
  auto first = RecordingWriter::create(folder.path() / "visit", test::small_header());
  ASSERT_TRUE(first);
  const auto second = RecordingWriter::create(folder.path() / "visit", test::small_header());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kBusy);
  EXPECT_TRUE(first->add_frame(test::small_frames()[0]));
  EXPECT_TRUE(first->finish());
}

TEST(RecordingWriter, RefusesAFolderThatHoldsSomething) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "mine.txt") << "x";
  const auto writer = RecordingWriter::create(folder.path(), test::small_header());
  ASSERT_FALSE(writer);
  EXPECT_NE(writer.error().line().find("new folder"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder.path() / "mine.txt"));
}

TEST(RecordingWriter, RefusesWhatCouldNotBeReadAgain) {
  const test::TemporaryFolder folder;
  auto header = test::small_header();
  header.cameras[1].geometry.id = header.cameras[0].geometry.id;
  EXPECT_FALSE(RecordingWriter::create(folder.path() / "a", header));
  EXPECT_FALSE(RecordingWriter::create(folder.path() / "b", Recording{}));
}

TEST(RecordingWriter, RefusesFramesThatDoNotFit) {
  const test::TemporaryFolder folder;
  auto writer = RecordingWriter::create(folder.path() / "visit", test::small_header());
  ASSERT_TRUE(writer);
  const auto good = test::small_frames()[2];
  ASSERT_TRUE(writer->add_frame(good));
  auto bad = good;
  bad.camera = "third";
  EXPECT_FALSE(writer->add_frame(bad));
  bad = good;
  bad.width = 48;
  bad.height = 64;
  EXPECT_FALSE(writer->add_frame(bad));
  bad = good;
  bad.raw.pop_back();
  EXPECT_FALSE(writer->add_frame(bad));
  bad = good;
  bad.depth_unit_mm = 1.0;
  EXPECT_FALSE(writer->add_frame(bad));
  bad = good;
  bad.device_time -= std::chrono::microseconds(1);
  EXPECT_FALSE(writer->add_frame(bad));
}

TEST(RecordingWriter, TellsThatAnEmptyRecordingIsNone) {
  const test::TemporaryFolder folder;
  auto writer = RecordingWriter::create(folder.path() / "visit", test::small_header());
  ASSERT_TRUE(writer);
  EXPECT_EQ(writer->finish().error().code, ErrorCode::kInsufficientData);
}

TEST(Recording, IsNotReadIntoMemoryBeyondTwoGigabytes) {
  Recording recording = test::small_header();
  auto& camera = recording.cameras[0].geometry;
  camera.intrinsics.width = 8192;
  camera.intrinsics.height = 8192;
  recording.frames.assign(17, RecordedFrame{camera.id, "0.png", {}});
  const auto frames = read_recorded_frames(recording);
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(frames.error().advice.find("fewer frames"), std::string::npos);
}

}  // namespace
}  // namespace instep
