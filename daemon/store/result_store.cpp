#include "daemon/store/result_store.h"

#include <algorithm>
#include <utility>

#include "daemon/store/scan_id.h"

namespace instep {
namespace {

constexpr const char* kWriting = ".writing-";
constexpr const char* kDeleting = ".deleting-";
constexpr std::size_t kLargestResultJson = 16 * 1024 * 1024;

bool is_leftover(const std::string& name) {
  return name.rfind(kWriting, 0) == 0 || name.rfind(kDeleting, 0) == 0;
}

bool is_number(const std::string& name, std::size_t digits) {
  return name.size() == digits && name.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

ResultStore::ResultStore(std::shared_ptr<Storage> storage, std::filesystem::path root)
    : storage_(std::move(storage)), root_(std::move(root)) {}

Result<std::size_t> ResultStore::prepare() {
  if (const auto made = storage_->make_folder(root_); !made) {
    return tl::make_unexpected(made.error());
  }
  const auto all_days = days();
  if (!all_days) return tl::make_unexpected(all_days.error());
  std::size_t cleared = 0;
  for (const auto& day : *all_days) {
    const auto entries = storage_->list(day);
    if (!entries) return tl::make_unexpected(entries.error());
    for (const auto& entry : *entries) {
      if (!entry.is_folder || !is_leftover(entry.name)) continue;
      if (const auto gone = empty_and_remove(day / entry.name); !gone) {
        return tl::make_unexpected(gone.error());
      }
      ++cleared;
    }
  }
  return cleared;
}

Result<std::filesystem::path> ResultStore::put(const std::string& id,
                                               const ResultContent& content) {
  if (!is_scan_id(id)) {
    return fail(ErrorCode::kInvalidInput, "\"" + id + "\" is not the id of a scan", "");
  }
  const auto day = root_ / day_folder(id);
  const auto writing = day / (kWriting + id);
  const auto stored = make_day_folder(id)
                          .and_then([&] { return storage_->make_folder(writing); })
                          .and_then([&] { return write_files(writing, content); })
                          .and_then([&] { return storage_->sync_folder(writing); })
                          .and_then([&] { return storage_->rename(writing, day / id); })
                          .and_then([&] { return storage_->sync_folder(day); });
  if (!stored) {
    // The failure to report is the first one, not that of clearing up after it.
    (void)empty_and_remove(writing);
    return tl::make_unexpected(stored.error());
  }
  return day / id;
}

Result<void> ResultStore::make_day_folder(const std::string& id) {
  if (const auto made = storage_->make_folder(root_); !made) return made;
  std::filesystem::path folder = root_;
  for (const auto& part : day_folder(id)) {
    const auto parent = folder;
    folder /= part;
    // The parent is flushed even if the folder was there: whoever made it may not have come to it.
    const auto made =
        storage_->make_folder(folder).and_then([&] { return storage_->sync_folder(parent); });
    if (!made) return made;
  }
  return {};
}

Result<void> ResultStore::write_files(const std::filesystem::path& folder,
                                      const ResultContent& content) {
  return write_file(folder / "result.json", content.result_json)
      .and_then([&] { return write_file(folder / "cloud.ply", content.cloud_ply); })
      .and_then([&] { return write_file(folder / "sections.svg", content.sections_svg); })
      .and_then([&] { return write_file(folder / "report.svg", content.report_svg); });
}

Result<void> ResultStore::write_file(const std::filesystem::path& path, std::string_view bytes) {
  const auto file = storage_->create_file(path);
  if (!file) return tl::make_unexpected(file.error());
  Result<void> outcome;
  while (!bytes.empty() && outcome) {
    const auto written = storage_->write(*file, bytes);
    if (written && *written > 0) {
      bytes.remove_prefix(std::min(*written, bytes.size()));
    } else {
      outcome = written ? fail(ErrorCode::kIo, "writing " + path.string() + " does not go on",
                               "check the disk of the results")
                        : tl::make_unexpected(written.error());
    }
  }
  if (outcome) outcome = storage_->sync(*file);
  storage_->close(*file);
  return outcome;
}

Result<void> ResultStore::empty_and_remove(const std::filesystem::path& folder) {
  const auto entries = storage_->list(folder);
  if (!entries) return tl::make_unexpected(entries.error());
  for (const auto& entry : *entries) {
    if (const auto gone = storage_->remove_file(folder / entry.name); !gone) return gone;
  }
  return storage_->remove_folder(folder);
}

Result<std::vector<std::filesystem::path>> ResultStore::days() const {
  std::vector<std::filesystem::path> level = {root_};
  for (const std::size_t digits : {4U, 2U, 2U}) {
    std::vector<std::filesystem::path> below;
    for (const auto& folder : level) {
      const auto entries = storage_->list(folder);
      if (!entries) return tl::make_unexpected(entries.error());
      for (const auto& entry : *entries) {
        if (entry.is_folder && is_number(entry.name, digits)) below.push_back(folder / entry.name);
      }
    }
    level = std::move(below);
  }
  return level;
}

Result<std::vector<std::string>> ResultStore::list() const {
  const auto all_days = days();
  if (!all_days) return tl::make_unexpected(all_days.error());
  std::vector<std::string> ids;
  for (const auto& day : *all_days) {
    const auto entries = storage_->list(day);
    if (!entries) return tl::make_unexpected(entries.error());
    for (const auto& entry : *entries) {
      if (entry.is_folder && is_scan_id(entry.name)) ids.push_back(entry.name);
    }
  }
  std::sort(ids.rbegin(), ids.rend());
  return ids;
}

Result<std::string> ResultStore::find(const std::string& id) const {
  if (id != "latest" && !is_scan_id(id)) {
    return fail(ErrorCode::kInvalidInput, "\"" + id + "\" is not the id of a scan",
                "instep list shows them");
  }
  const auto ids = list();
  if (!ids) return tl::make_unexpected(ids.error());
  if (id == "latest" && !ids->empty()) return ids->front();
  if (std::find(ids->begin(), ids->end(), id) != ids->end()) return id;
  return id == "latest"
             ? fail(ErrorCode::kNotFound, "there is no scan yet", "make one: instep scan")
             : fail(ErrorCode::kNotFound, "there is no scan " + id,
                    "instep list shows those there are");
}

std::filesystem::path ResultStore::folder_of(const std::string& id) const {
  return root_ / day_folder(id) / id;
}

Result<std::string> ResultStore::read_result_json(const std::string& id) const {
  return storage_->read(folder_of(id) / "result.json", kLargestResultJson);
}

Result<void> ResultStore::remove(const std::string& id) {
  const auto found = find(id);
  if (!found) return tl::make_unexpected(found.error());
  const auto day = root_ / day_folder(*found);
  const auto deleting = day / (kDeleting + *found);
  return storage_->rename(day / *found, deleting)
      .and_then([&] { return storage_->sync_folder(day); })
      .and_then([&] { return empty_and_remove(deleting); });
}

Result<std::size_t> ResultStore::sweep(const Retention& retention,
                                       std::chrono::system_clock::time_point now) {
  if (retention.keep_days == 0 && retention.keep_count == 0) return 0;
  const auto ids = list();
  if (!ids) return tl::make_unexpected(ids.error());
  const auto oldest = now - std::chrono::hours(24) * retention.keep_days;
  std::size_t removed = 0;
  for (std::size_t i = 0; i < ids->size(); ++i) {
    const auto time = time_of_scan_id((*ids)[i]);
    const bool too_old = retention.keep_days > 0 && time && *time < oldest;
    const bool too_many =
        retention.keep_count > 0 && i >= static_cast<std::size_t>(retention.keep_count);
    if (!too_old && !too_many) continue;
    if (const auto gone = remove((*ids)[i]); !gone) return tl::make_unexpected(gone.error());
    ++removed;
  }
  return removed;
}

}  // namespace instep
