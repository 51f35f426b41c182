#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "daemon/store/result_content.h"
#include "daemon/store/storage.h"

namespace instep {

/// How long results are kept; 0 = no limit.
struct Retention {
  int keep_days = 0;
  int keep_count = 0;
};

/// The results on disk: <root>/YYYY/MM/DD/<id>/ with result.json, cloud.ply, sections.svg and
/// report.svg.
///
/// A result appears whole or not at all, whatever fails and whenever the power goes: it is written
/// under a temporary name in the folder where it will lie, each file and the folder are flushed,
/// then it is renamed, and the folder above is flushed. A result that put() has reported is
/// durable.
///
/// Holds no state but the disk's. Safe from many threads.
class ResultStore {
 public:
  ResultStore(std::shared_ptr<Storage> storage, std::filesystem::path root);

  const std::filesystem::path& root() const { return root_; }

  /// Makes the root (its parent must be there) and clears what an earlier run left half-done.
  /// Returns how many leftovers there were.
  Result<std::size_t> prepare();

  /// Stores a result and returns its folder. On failure nothing is left but, if the cleaning up
  /// fails too, a leftover that prepare() clears.
  Result<std::filesystem::path> put(const std::string& id, const ResultContent& content);

  /// All ids, newest first.
  Result<std::vector<std::string>> list() const;

  /// `id`, or the newest if it is "latest". Fails with kNotFound if there is none, and with
  /// kInvalidInput if `id` cannot be one.
  Result<std::string> find(const std::string& id) const;

  std::filesystem::path folder_of(const std::string& id) const;
  Result<std::string> read_result_json(const std::string& id) const;

  /// Takes the result away as a whole.
  Result<void> remove(const std::string& id);

  /// Removes what is too old or too many. Returns how many.
  Result<std::size_t> sweep(const Retention& retention, std::chrono::system_clock::time_point now);

 private:
  Result<void> make_day_folder(const std::string& id);
  Result<void> write_file(const std::filesystem::path& path, std::string_view bytes);
  Result<void> write_files(const std::filesystem::path& folder, const ResultContent& content);
  Result<void> empty_and_remove(const std::filesystem::path& folder);
  /// The folders of all days, oldest first.
  Result<std::vector<std::filesystem::path>> days() const;

  std::shared_ptr<Storage> storage_;
  std::filesystem::path root_;
};

}  // namespace instep
