#include "daemon/scan/recorded_capture.h"

#include <utility>

#include "drivers/recording/recording_reader.h"

namespace instep {

Result<Capture> read_capture(const std::filesystem::path& folder) {
  auto recording = read_recording(folder);
  if (!recording) return tl::make_unexpected(recording.error());
  auto frames = read_recorded_frames(*recording);
  if (!frames) return tl::make_unexpected(frames.error());
  Capture capture;
  capture.cameras = recording->cameras;
  capture.frames = std::move(*frames);
  capture.platform_height_mm = recording->platform_height_mm;
  capture.simulated = recording->simulated;
  capture.truth = recording->truth;
  capture.calibration = "recording";
  return capture;
}

}  // namespace instep
