#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/result.h"
#include "drivers/recording/recording.h"

namespace instep {

/// The text of recording.json for `recording`; its folder plays no part. Reading it back gives the
/// same numbers, bit by bit, and the same texts, but for bytes that are no UTF-8.
std::string recording_to_json(const Recording& recording);

/// The inverse, with all the checks of read_recording(). `file` is used in messages, and its folder
/// becomes Recording::folder.
Result<Recording> recording_from_json(std::string_view text, const std::filesystem::path& file);

}  // namespace instep
