#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "core/result.h"

namespace instep {

/// The largest settings file that is read; a real one has 3 kB.
inline constexpr std::size_t kLargestSettingsFile = 256 * 1024;

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
Result<Settings> load_settings(const std::filesystem::path& file);

}  // namespace instep
