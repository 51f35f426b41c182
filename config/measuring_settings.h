#pragma once

#include <filesystem>

#include "config/reading/settings_table.h"
#include "core/foot/measuring_rules.h"
#include "core/foot/shoe_sizes.h"
#include "core/result.h"

namespace instep {

/// What of a station's settings counts where no station is needed: the tables [measures] and
/// [sizes].
struct MeasuringSettings {
  MeasuringRules measures;
  SizeRules sizes;
};

/// Reads the two tables of `root`.
void read_measuring(SettingsTable& root, MeasuringRules& measures, SizeRules& sizes,
                    SettingsFaults& faults);

/// Reads no more than the two of a settings file: what is wrong with its cameras or its pedal is
/// nobody's concern who measures a cloud. A table of a name that no settings have is a fault all
/// the same, since it may be one of the two, mistyped. Fails as load_settings() does.
Result<MeasuringSettings> load_measuring_settings(const std::filesystem::path& file);

}  // namespace instep
