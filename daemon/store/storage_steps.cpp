#include "daemon/store/storage_steps.h"

#include <algorithm>

namespace instep {

Result<void> write_file(Storage& storage, const std::filesystem::path& path,
                        std::string_view bytes) {
  const auto file = storage.create_file(path);
  if (!file) return tl::make_unexpected(file.error());
  Result<void> outcome;
  while (!bytes.empty() && outcome) {
    const auto written = storage.write(*file, bytes);
    if (written && *written > 0) {
      bytes.remove_prefix(std::min(*written, bytes.size()));
    } else {
      outcome = written ? fail(ErrorCode::kIo, "writing " + path.string() + " does not go on",
                               "check the disk of the results")
                        : tl::make_unexpected(written.error());
    }
  }
  if (outcome) outcome = storage.sync(*file);
  storage.close(*file);
  return outcome;
}

Result<void> remove_whole(Storage& storage, const std::filesystem::path& folder) {
  const auto entries = storage.list(folder);
  if (!entries) return tl::make_unexpected(entries.error());
  for (const auto& entry : *entries) {
    const auto gone = entry.is_folder ? remove_whole(storage, folder / entry.name)
                                      : storage.remove_file(folder / entry.name);
    if (!gone) return gone;
  }
  return storage.remove_folder(folder);
}

}  // namespace instep
