#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "core/fusion/frames/depth_frame.h"
#include "core/result.h"
#include "drivers/files/descriptor.h"
#include "drivers/recording/recording.h"

namespace instep {

/// Writes a recording that appears whole or not at all: all of it in a folder `.unfinished` within
/// its own, out of which it is brought by renaming, `recording.json` last. A writer that is
/// destroyed before finish() takes away what it wrote; what the sudden end of a program has left
/// there does the next one that is given the same folder.
///
///     auto writer = RecordingWriter::create("/data/visit", header);
///     writer->add_frame(frame); ...
///     writer->finish();
///
/// One thread at a time. Cost of a frame: its compression and one sync of the disk.
class RecordingWriter {
 public:
  /// Whether a recording can be written there, as far as can be told without making anything:
  /// kInvalidInput where something else is there. For those who would work long in vain.
  static Result<void> check_folder(const std::filesystem::path& folder);

  /// `header` holds everything but folder and frames, which are ignored. Makes `folder`; it must
  /// not exist, be empty or hold what a sudden end has left (check_folder()); kBusy where another
  /// program writes there. Also fails where the cameras are not ones that
  /// read_recording() would take, and with kPermissionDenied or kNoSpace.
  static Result<RecordingWriter> create(const std::filesystem::path& folder, Recording header);

  RecordingWriter(RecordingWriter&&) noexcept = default;
  RecordingWriter& operator=(RecordingWriter&&) = delete;
  ~RecordingWriter();

  /// Writes the image of a frame. Its camera must be one of the header's, its size that camera's,
  /// and its device_time not before the camera's last one (kInvalidInput).
  Result<void> add_frame(const DepthFrame& frame);

  /// Writes recording.json. After it nothing can be added. Fails with kInsufficientData without
  /// frames.
  Result<void> finish();

  const Recording& recording() const { return recording_; }

 private:
  RecordingWriter(Recording recording, Descriptor held)
      : recording_(std::move(recording)), held_(std::move(held)) {}

  struct CameraState {
    std::size_t frames = 0;
    std::chrono::microseconds latest{0};
  };

  Recording recording_;
  Descriptor held_;  ///< the folder, against another program's writing there
  std::map<std::string, CameraState> states_;
  bool made_folder_ = false;
};

}  // namespace instep
