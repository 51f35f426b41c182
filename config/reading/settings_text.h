#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/result.h"

namespace instep {

/// The largest settings or calibration file that is read; a real one has 3 kB.
inline constexpr std::size_t kLargestSettingsFile = 256 * 1024;

/// The content of a file that errors call `what`, such as "settings file". Fails with
/// kPermissionDenied or kIo if it cannot be opened, with kIo if reading breaks off, with
/// kInvalidInput if it is too large.
Result<std::string> read_settings_text(const std::filesystem::path& file, const std::string& what);

}  // namespace instep
