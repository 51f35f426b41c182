#pragma once

#include <filesystem>

#include "core/result.h"
#include "daemon/scan/scan_pipeline.h"

namespace instep {

/// A recording with all its frames, as if its cameras had just brought it in. Fails as
/// read_recording() and read_recorded_frames() do.
Result<Capture> read_capture(const std::filesystem::path& folder);

}  // namespace instep
