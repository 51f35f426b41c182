#pragma once

#include <filesystem>

#include "config/settings.h"
#include "core/result.h"

namespace instep {

/// The settings, with their real cameras where the calibration that lies beside their file has
/// those of the same name; Settings::calibration says what it did. Cameras of a simulation or a
/// recording bring their own poses, and without a calibration all stay as they are. Fails, naming
/// the file and what to do, if it cannot be read or is faulty: the settings' poses in its stead
/// would be wrong without a word.
Result<Settings> with_calibration_beside(const std::filesystem::path& settings_file,
                                         Settings settings);

}  // namespace instep
