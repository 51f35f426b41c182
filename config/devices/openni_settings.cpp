#include "config/devices/openni_settings.h"

#include <fmt/format.h>

#include "config/poses/camera_placement_table.h"
#include "config/reading/settings_table.h"

namespace instep {

OpenniSettings read_openni_settings(SettingsTable& table, const std::filesystem::path& base,
                                    SettingsFaults& faults) {
  constexpr std::size_t kLongestSerial = 64;
  OpenniSettings settings;
  table.read("serial", settings.serial, kLongestSerial);
  table.read("library_folder", settings.library_folder, base);
  settings.placement = read_camera_placement(table, faults);
  return settings;
}

std::string describe(const OpenniSettings& settings) {
  const auto& [placement, serial, library_folder] = settings;
  std::string text = fmt::format("{}, the OpenNI2 sensor {}", placement.name,
                                 serial.empty() ? "that is plugged in" : serial);
  if (!library_folder.empty()) text += " through the library in " + library_folder.string();
  return text + (placement.intrinsics ? ", lens as the settings say" : ", lens as the sensor says");
}

}  // namespace instep
