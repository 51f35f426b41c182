#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/fusion/frames/depth_frame.h"
#include "core/result.h"
#include "drivers/recording/recording.h"

namespace instep {

/// Reads and checks `recording.json` in `folder`; no image is opened. Everything is demanded: the
/// format and its version, each key's kind and range, lens and pose of each camera
/// (check_intrinsics(), is_rigid()), distinct camera ids, frames of known cameras only, and file
/// names that stay in the folder. Unknown keys are passed over.
///
/// The first fault is returned with the name of the file, the place in it and what to do. At most
/// kMostRecordingCameras and kMostRecordingFrames are taken.
Result<Recording> read_recording(const std::filesystem::path& folder);

/// Reads the pixels of one frame (`index` < frames.size()). DepthFrame::sequence is as given and
/// host_time is left at its default. Fails like read_depth_png(), with kCorruptData if the image
/// has another size than its camera, and with kInvalidInput if a symbolic link leads out of the
/// recording.
Result<DepthFrame> read_recorded_frame(const Recording& recording, std::size_t index,
                                       std::uint64_t sequence);

/// All frames in order, their sequence being the place among those of their camera; the first fault
/// ends it. Fails with kUnsupported if they need more than 2 GiB.
Result<std::vector<DepthFrame>> read_recorded_frames(const Recording& recording);

}  // namespace instep
