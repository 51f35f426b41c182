#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <functional>
#include <string_view>

#include "config/reading/settings_table.h"

namespace instep {

/// Parses TOML text and hands it to `read`, once, unless it is none: that is a fault. So is a
/// number that no computer holds, which hides nothing else that is wrong: `read` finds a 0 in its
/// place, and what is wrong with that 0 is no fault. `file` is named in the faults.
void read_toml(std::string_view text, const std::filesystem::path& file, SettingsFaults& faults,
               const std::function<void(const toml::table&)>& read);

}  // namespace instep
