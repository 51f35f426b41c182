#pragma once

#include "config/devices/v4l2_settings.h"
#include "config/reading/settings_table.h"

namespace instep {

/// Reads the keys of a [[camera]] table of kind "v4l2", those of its placement included:
///
///     serial = "819312071039"
///     bus_path = "usb-0000:00:14.0-2"
///     format = "Z16"
///     depth_unit_mm = 1.0
///     controls = [ { name = "auto_exposure", value = 1 },
///                  { name = "exposure_time_absolute", value = 85 } ]
///
/// What is missing or cannot be right leaves a fault.
V4l2Settings read_v4l2_settings(SettingsTable& table, SettingsFaults& faults);

}  // namespace instep
