#pragma once

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

namespace instep {

struct FolderEntries {
  std::vector<std::filesystem::path> paths;  ///< in the order of their names
  std::error_code failure;                   ///< why some may be missing; none if all are there
};

/// What is in a folder itself under names that begin so, as far as it can be read. A folder of
/// devices may go while it is read: a range-for over it would throw then.
inline FolderEntries entries_of(const std::filesystem::path& folder, std::string_view prefix = {}) {
  namespace fs = std::filesystem;
  FolderEntries entries;
  for (auto entry = fs::directory_iterator(folder, entries.failure);
       !entries.failure && entry != fs::end(entry); entry.increment(entries.failure)) {
    const fs::path& path = entry->path();
    if (path.filename().native().starts_with(prefix)) entries.paths.push_back(path);
  }
  std::sort(entries.paths.begin(), entries.paths.end());
  return entries;
}

}  // namespace instep
