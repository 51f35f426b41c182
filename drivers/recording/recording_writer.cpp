#include "drivers/recording/recording_writer.h"

#include <fmt/core.h>

#include <system_error>

#include "drivers/files/file_bytes.h"
#include "drivers/recording/depth_png.h"
#include "drivers/recording/recording_json.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

fs::path camera_folder(std::size_t camera) {
  return fmt::format("camera{:02}", camera);
}

tl::unexpected<Error> bad_frame(const DepthFrame& frame, const std::string& what) {
  return fail(ErrorCode::kInvalidInput,
              fmt::format("frame {} of camera \"{}\" {}", frame.sequence, frame.camera, what),
              "hand in frames as the recorded cameras give them");
}

/// The header must be one that can be read again: it is read again, with one frame put in.
Result<void> check_header(Recording header, const fs::path& file) {
  header.frames.clear();
  if (!header.cameras.empty()) {
    header.frames.push_back({header.cameras[0].geometry.id, "0.png", {}});
  }
  const auto again = recording_from_json(recording_to_json(header), file);
  if (!again) return tl::make_unexpected(again.error());
  return {};
}

}  // namespace

Result<RecordingWriter> RecordingWriter::create(const fs::path& folder, Recording header) {
  header.folder = folder;
  header.frames.clear();
  if (auto good = check_header(header, folder / kRecordingFileName); !good) {
    return tl::make_unexpected(good.error());
  }
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_empty(folder, error)) {
    return fail(ErrorCode::kInvalidInput, folder.string() + " is there and not empty",
                "give the name of a new folder");
  }
  RecordingWriter writer(std::move(header));
  writer.made_folder_ = fs::create_directories(folder, error);
  for (std::size_t i = 0; !error && i < writer.recording_.cameras.size(); ++i) {
    fs::create_directory(folder / camera_folder(i), error);
  }
  if (error) return tl::make_unexpected(file_error(error.value(), "make", folder));
  return writer;
}

RecordingWriter::~RecordingWriter() {
  if (recording_.folder.empty()) return;  // moved from, or finished
  std::error_code ignored;
  for (const auto& frame : recording_.frames) fs::remove(recording_.folder / frame.file, ignored);
  for (std::size_t i = 0; i < recording_.cameras.size(); ++i) {
    fs::remove(recording_.folder / camera_folder(i), ignored);
  }
  if (made_folder_) fs::remove(recording_.folder, ignored);
}

Result<void> RecordingWriter::add_frame(const DepthFrame& frame) {
  const CameraDescription* camera = recording_.find_camera(frame.camera);
  if (camera == nullptr) return bad_frame(frame, "is of no camera of the recording");
  const auto& lens = camera->geometry.intrinsics;
  if (frame.width != lens.width || frame.height != lens.height) {
    return bad_frame(frame, "has another size than its camera");
  }
  if (frame.depth_unit_mm != camera->depth_unit_mm) {
    return bad_frame(frame, "has another depth unit than its camera");
  }
  auto& state = states_[frame.camera];
  if (frame.device_time < state.latest) return bad_frame(frame, "is older than the one before it");
  if (recording_.frames.size() >= kMostRecordingFrames) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("a recording holds at most {} frames", kMostRecordingFrames),
                "record for a shorter time");
  }

  const auto bytes = encode_depth_png({frame.width, frame.height, frame.raw});
  if (!bytes) return tl::make_unexpected(bytes.error());
  const auto file = camera_folder(static_cast<std::size_t>(camera - recording_.cameras.data())) /
                    fmt::format("{:06}.png", state.frames);
  if (auto good = write_file_bytes(recording_.folder / file, *bytes); !good) return good;
  recording_.frames.push_back({frame.camera, file, frame.device_time});
  state = {state.frames + 1, frame.device_time};
  return {};
}

Result<void> RecordingWriter::finish() {
  if (recording_.frames.empty()) {
    return fail(ErrorCode::kInsufficientData, "a recording needs at least one frame",
                "check that the cameras give frames");
  }
  const auto file = recording_.folder / kRecordingFileName;
  if (auto good = write_file_bytes(file, recording_to_json(recording_)); !good) return good;
  recording_.folder.clear();  // nothing to take away any more
  return {};
}

}  // namespace instep
