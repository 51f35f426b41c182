#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace instep {

/// New ids for the feet of one scan, in the order of the feet, which is that of the ids as well:
/// UTC time to the millisecond, the same for all, and some random letters, such as
/// "20261121T091502417Z-k3f9".
std::vector<std::string> new_scan_ids(std::chrono::system_clock::time_point time,
                                      std::size_t count);

/// True for what has the form of those that new_scan_ids() makes, though there may be no such date
/// or time of day; an id that passes is safe in a path.
bool is_scan_id(std::string_view id);

/// YYYY/MM/DD of an id for which is_scan_id() holds: where its result lies under the store's root.
std::filesystem::path day_folder(std::string_view id);

/// Whether two ids were made together.
bool are_of_one_scan(std::string_view one, std::string_view other);

/// The time in an id, to the millisecond; nothing if there is no such date.
std::optional<std::chrono::system_clock::time_point> time_of_scan_id(std::string_view id);

}  // namespace instep
