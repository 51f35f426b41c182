#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "core/result.h"

namespace instep {

/// What was found in a settings file: the settings if there is no fault, else every fault as
/// "file:line: what is wrong and what would be right", in the order of the file.
struct SettingsReading {
  Settings settings;
  std::vector<std::string> faults;

  bool good() const { return faults.empty(); }
};

/// Reads settings from TOML text. An unknown key, a wrong type, a value out of its range and a word
/// that is not among the choices are faults; all of a file are found in one go. Relative paths are
/// taken from the folder of `file`. Never throws, never touches the disk.
SettingsReading read_settings(std::string_view toml, const std::filesystem::path& file);

/// Reads the file and hands it to read_settings(). Fails with kNotFound, kPermissionDenied or kIo
/// if there is no reading it, and with kInvalidInput, all faults in the message, if it is wrong.
/// The calibration that lies beside it (calibration_file.h) puts the real cameras where it found
/// them; a faulty one fails too, with what to do about it.
Result<Settings> load_settings(const std::filesystem::path& file);

/// The same with the file's own poses, whatever lies beside it: for whoever calibrates anew, which
/// has to go on where the old calibration is faulty.
Result<Settings> load_uncalibrated_settings(const std::filesystem::path& file);

}  // namespace instep
