#pragma once

#include <filesystem>
#include <string>

#include "config/poses/camera_placement.h"

namespace instep {

class SettingsFaults;
class SettingsTable;

/// A [[camera]] of kind "openni2".
struct OpenniSettings {
  CameraPlacement placement;
  std::string serial;  ///< at most 64 characters; empty = the only sensor there is
  /// Folder of the maker's libOpenNI2.so.0, which has OpenNI2/Drivers in it; empty = the system's.
  std::filesystem::path library_folder;
};

/// Reads `serial`, `library_folder` (taken from `base` if it is relative) and the placement.
OpenniSettings read_openni_settings(SettingsTable& table, const std::filesystem::path& base,
                                    SettingsFaults& faults);

/// The lines of `instepd --check` say it so.
std::string describe(const OpenniSettings& settings);

}  // namespace instep
