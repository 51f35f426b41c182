#include "drivers/recording/recording_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <system_error>

#include "drivers/files/file_bytes.h"
#include "drivers/recording/depth_png.h"
#include "drivers/recording/recording_json.h"

namespace instep {
namespace {

constexpr std::size_t kMostJsonBytes = std::size_t{64} << 20;
constexpr std::size_t kMostFrameBytes = std::size_t{2} << 30;

Result<void> check_inside(const Recording& recording, const std::filesystem::path& file) {
  std::error_code error;
  const auto folder = std::filesystem::weakly_canonical(recording.folder, error);
  const auto target = error ? file : std::filesystem::weakly_canonical(file, error);
  if (error) return tl::make_unexpected(file_error(error.value(), "read", file));
  const auto [end, ignored] =
      std::mismatch(folder.begin(), folder.end(), target.begin(), target.end());
  if (end == folder.end()) return {};
  return fail(ErrorCode::kInvalidInput,
              fmt::format("{} leads out of the recording's folder", file.string()),
              "copy the image into the folder");
}

/// PNG packs an empty image a thousandfold, so a small folder can hold more than any memory.
Result<void> check_fits_memory(const Recording& recording) {
  std::size_t bytes = 0;
  for (const auto& recorded : recording.frames) {
    const auto& lens = recording.find_camera(recorded.camera)->geometry.intrinsics;
    bytes += sizeof(std::uint16_t) * static_cast<std::size_t>(lens.width) *
             static_cast<std::size_t>(lens.height);
  }
  if (bytes <= kMostFrameBytes) return {};
  return fail(
      ErrorCode::kUnsupported,
      fmt::format("the {} frames of {} have {} bytes, more than the {} that are read",
                  recording.frames.size(), recording.folder.string(), bytes, kMostFrameBytes),
      "record fewer frames");
}

}  // namespace

Result<Recording> read_recording(const std::filesystem::path& folder) {
  if (folder.empty()) {
    return fail(ErrorCode::kInvalidInput, "the name of the recording is empty",
                fmt::format("give the folder that holds {}", kRecordingFileName));
  }
  std::error_code error;
  if (std::filesystem::is_regular_file(folder, error)) {
    return fail(ErrorCode::kInvalidInput, folder.string() + " is a file",
                fmt::format("give the folder that holds {}", kRecordingFileName));
  }
  const auto file = folder / kRecordingFileName;
  const auto text = read_file_bytes(file, kMostJsonBytes);
  if (!text) return tl::make_unexpected(text.error());
  return recording_from_json(*text, file);
}

Result<DepthFrame> read_recorded_frame(const Recording& recording, std::size_t index,
                                       std::uint64_t sequence) {
  const RecordedFrame& recorded = recording.frames[index];
  const CameraDescription* camera = recording.find_camera(recorded.camera);
  const auto file = recording.folder / recorded.file;
  if (auto good = check_inside(recording, file); !good) return tl::make_unexpected(good.error());
  auto image = read_depth_png(file);
  if (!image) return tl::make_unexpected(image.error());

  const auto& lens = camera->geometry.intrinsics;
  if (image->width != lens.width || image->height != lens.height) {
    return fail(ErrorCode::kCorruptData,
                fmt::format("{} has {} x {} pixels, its camera {} x {}", file.string(),
                            image->width, image->height, lens.width, lens.height),
                "correct the camera's size or record again");
  }
  DepthFrame frame;
  frame.camera = recorded.camera;
  frame.sequence = sequence;
  frame.width = image->width;
  frame.height = image->height;
  frame.depth_unit_mm = camera->depth_unit_mm;
  frame.raw = std::move(image->raw);
  frame.device_time = recorded.time;
  return frame;
}

Result<std::vector<DepthFrame>> read_recorded_frames(const Recording& recording) {
  if (auto good = check_fits_memory(recording); !good) return tl::make_unexpected(good.error());
  std::map<std::string, std::uint64_t> sequence;
  std::vector<DepthFrame> frames;
  frames.reserve(recording.frames.size());
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    auto frame = read_recorded_frame(recording, i, sequence[recording.frames[i].camera]++);
    if (!frame) return tl::make_unexpected(frame.error());
    frames.push_back(std::move(*frame));
  }
  return frames;
}

}  // namespace instep
