#pragma once

#include <filesystem>
#include <string>

namespace instep {

/// The one line that a file of sysfs holds, without its end; empty if there is none, as when the
/// device has just left. At most 4095 characters.
std::string sysfs_line(const std::filesystem::path& file);

}  // namespace instep
