#pragma once

#include <filesystem>

#include "config/settings.h"
#include "core/result.h"
#include "daemon/command_line/recordings/capture_recording.h"
#include "daemon/command_line/stop_request.h"
#include "drivers/recording/recording.h"

namespace instep {

/// Opens the cameras of a station and records what they see, as capture_recording() does: with the
/// projector lit if there is one, after the frames that warm a camera up and in turns where the
/// settings say so, and with the truth about what stands on a simulated platform. Shows how far it
/// is, and fails with kCancelled once `stop` is made. The daemon must not have them: a camera has
/// one reader. Fails with kBusy if one runs, as ControlClient::connect() does if that cannot be
/// told, and as open_devices() and capture_recording() do.
Result<Recording> record_station(const Settings& settings, const RecordingLength& length,
                                 const std::filesystem::path& folder, const StopRequest& stop);

}  // namespace instep
