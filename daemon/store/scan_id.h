#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string_view>

namespace instep {

/// True for what new_scan_id() makes, and for nothing else; an id that passes is safe in a path.
bool is_scan_id(std::string_view id);

/// YYYY/MM/DD of an id for which is_scan_id() holds: where its result lies under the store's root.
std::filesystem::path day_folder(std::string_view id);

/// The time in an id, to the second; nothing if there is no such date.
std::optional<std::chrono::system_clock::time_point> time_of_scan_id(std::string_view id);

}  // namespace instep
