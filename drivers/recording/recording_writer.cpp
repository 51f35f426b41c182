#include "drivers/recording/recording_writer.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>

#include <cerrno>
#include <iterator>
#include <system_error>

#include "drivers/files/file_bytes.h"
#include "drivers/recording/depth_png.h"
#include "drivers/recording/recording_json.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

/// What a recording is written in until it is whole. One that a sudden end has left is known by it.
constexpr const char* kUnfinished = ".unfinished";

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

bool holds_only_unfinished(const fs::path& folder, std::error_code& error) {
  const fs::directory_iterator first(folder, error);
  if (error || first == fs::directory_iterator()) return false;
  return first->path().filename() == kUnfinished && std::next(first) == fs::directory_iterator();
}

/// Takes hold of a folder that one program at a time may write in.
Result<Descriptor> hold(const fs::path& folder) {
  Descriptor held(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!held.is_open()) return tl::make_unexpected(file_error(errno, "open", folder));
  if (::flock(held.number(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return held;
  return fail(ErrorCode::kBusy, "another program records to " + folder.string(),
              "give the name of another folder");
}

}  // namespace

Result<void> RecordingWriter::check_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error) || fs::is_empty(folder, error)) return {};
  if (holds_only_unfinished(folder, error)) return {};
  return fail(ErrorCode::kInvalidInput, folder.string() + " is there and not empty",
              "give the name of a new folder");
}

Result<RecordingWriter> RecordingWriter::create(const fs::path& folder, Recording header) {
  header.folder = folder;
  header.frames.clear();
  if (auto good = check_header(header, folder / kRecordingFileName); !good) {
    return tl::make_unexpected(good.error());
  }
  if (auto good = check_folder(folder); !good) return tl::make_unexpected(good.error());
  std::error_code error;
  const bool is_left_half_done = holds_only_unfinished(folder, error);
  const bool made_folder = fs::create_directories(folder, error);
  if (error) return tl::make_unexpected(file_error(error.value(), "make", folder));
  auto held = hold(folder);
  if (!held) return tl::make_unexpected(held.error());
  RecordingWriter writer(std::move(header), std::move(*held));
  writer.made_folder_ = made_folder || is_left_half_done;
  const auto unfinished = folder / kUnfinished;
  fs::remove_all(unfinished, error);
  if (!error) fs::create_directory(unfinished, error);
  for (std::size_t i = 0; !error && i < writer.recording_.cameras.size(); ++i) {
    fs::create_directory(unfinished / camera_folder(i), error);
  }
  if (error) return tl::make_unexpected(file_error(error.value(), "make", unfinished));
  return writer;
}

RecordingWriter::~RecordingWriter() {
  if (recording_.folder.empty()) return;  // moved from, or finished
  std::error_code ignored;
  fs::remove_all(recording_.folder / kUnfinished, ignored);
  for (std::size_t i = 0; i < recording_.cameras.size(); ++i) {
    fs::remove_all(recording_.folder / camera_folder(i), ignored);  // where finish() failed
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
  if (auto good = write_file_bytes(recording_.folder / kUnfinished / file, *bytes); !good)
    return good;
  recording_.frames.push_back({frame.camera, file, frame.device_time});
  state = {state.frames + 1, frame.device_time};
  return {};
}

Result<void> RecordingWriter::finish() {
  if (recording_.frames.empty()) {
    return fail(ErrorCode::kInsufficientData, "a recording needs at least one frame",
                "check that the cameras give frames");
  }
  const auto unfinished = recording_.folder / kUnfinished;
  const auto json = recording_to_json(recording_);
  if (auto good = write_file_bytes(unfinished / kRecordingFileName, json); !good) return good;
  std::error_code error;
  const auto bring_out = [&](const fs::path& name) {
    if (!error) fs::rename(unfinished / name, recording_.folder / name, error);
  };
  for (std::size_t i = 0; i < recording_.cameras.size(); ++i) bring_out(camera_folder(i));
  bring_out(kRecordingFileName);  // last, for with it the recording is whole
  if (error) return tl::make_unexpected(file_error(error.value(), "finish", recording_.folder));
  fs::remove(unfinished, error);
  recording_.folder.clear();  // nothing to take away any more
  return {};
}

}  // namespace instep
