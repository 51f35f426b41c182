#include "daemon/store/result_store.h"

#include <algorithm>
#include <mutex>
#include <shared_mutex>
#include <utility>

#include <unistd.h>

#include "daemon/scan/scan_id.h"
#include "daemon/store/storage_steps.h"

namespace instep {
namespace {

constexpr const char* kWriting = ".writing-";
constexpr const char* kDeleting = ".deleting-";
constexpr const char* kTrial = ".trying-out-";  // and whose it is
/// As large as a result with its cloud, so that a disk which takes it takes the next scan too.
constexpr std::size_t kSmallestTrial = 2 * 1024 * 1024;
/// No two scans are of one size, and their folders take room as well.
constexpr std::size_t kMoreByShare = 8;
constexpr std::size_t kLargestResultJson = 16 * 1024 * 1024;
/// Results that were stored last. It takes as many deletions to make an earlier one the latest.
constexpr std::size_t kRemembered = 100;

bool is_leftover(const Storage::Entry& entry) {
  const auto is_some = [&](const char* kind) { return entry.name.rfind(kind, 0) == 0; };
  return entry.is_folder ? is_some(kWriting) || is_some(kDeleting) : is_some(kTrial);
}

void keep_first(const Error& error, std::optional<Error>& first) {
  if (!first) first = error;
}

bool is_number(const std::string& name, std::size_t digits) {
  return name.size() == digits && name.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

ResultStore::ResultStore(std::shared_ptr<Storage> storage, std::filesystem::path root)
    : storage_(storage), root_(std::move(storage), std::move(root)) {}

Result<Prepared> ResultStore::prepare(const OnDay& on_day) {
  const auto is_ours = take_root();
  if (!is_ours) return tl::make_unexpected(is_ours.error());
  // Whatever comes of the rest: who has the root alone keeps all others out.
  const struct Sharing {
    StoreRoot& root;
    ~Sharing() { root.share(); }
  } sharing{root_};
  // While it is held alone, by which it is the one that was taken: were it lost in the clearing,
  // another's mark would be taken for its own, and without one it is never known again.
  if (check_root()) root_.mark();
  // Before the clearing, which reads every day: a scan that begins meanwhile asks time_of_next().
  find_newest();
  Result<Prepared> prepared;
  if (*is_ours) {
    prepared = clear_leftovers(on_day);
  } else {
    prepared->is_shared = true;
  }
  return prepared;
}

Result<bool> ResultStore::take_root() {
  const std::unique_lock nobody_writes(clearing_);
  return root_.take();
}

Result<Prepared> ResultStore::clear_leftovers(const OnDay& on_day) {
  Prepared prepared;
  const auto all_days = days();
  if (!all_days) return tl::make_unexpected(all_days.error());
  for (const auto& day : *all_days) {
    on_day();
    // Of each day anew: a scan that is to be stored waits for one at most.
    const std::unique_lock nobody_writes(clearing_);
    if (const auto there = check_root(); !there) return tl::make_unexpected(there.error());
    clear_day(day, prepared);
  }
  return prepared;
}

void ResultStore::clear_day(const std::filesystem::path& day, Prepared& prepared) {
  const auto entries = storage_->list(day);
  if (!entries) return keep_first(entries.error(), prepared.trouble);
  for (const auto& entry : *entries) {
    if (!is_leftover(entry)) continue;
    const auto leftover = day / entry.name;
    const auto gone =
        entry.is_folder ? remove_whole(*storage_, leftover) : storage_->remove_file(leftover);
    if (gone) {
      prepared.cleared += entry.is_folder ? 1 : 0;
    } else {
      keep_first(gone.error(), prepared.trouble);
    }
  }
}

Result<void> ResultStore::check_root() {
  return root_.check();
}

Result<void> ResultStore::try_out(std::chrono::system_clock::time_point now) {
  if (!root_.is_taken()) {
    const auto is_ours = root_.take();
    if (!is_ours) return tl::make_unexpected(is_ours.error());
    find_newest();
    root_.share();
  }
  if (auto there = check_root(); !there) return there;
  root_.mark();
  // The next result goes to the folder of its day, which may be a link to another disk.
  const auto id = new_scan_ids(now, 1).front();
  if (auto made = make_day_folder(id); !made) return made;
  const auto trial = root() / day_folder(id) / (kTrial + std::to_string(::getpid()));
  // One that a sudden end has left; mostly there is none.
  (void)storage_->remove_file(trial);
  const std::size_t size = largest_scan_ + largest_scan_ / kMoreByShare;
  const auto tried = write_file(*storage_, trial, std::string(std::max(kSmallestTrial, size), 'x'));
  const auto gone = storage_->remove_file(trial);
  return tried ? gone : tried;
}

void ResultStore::expect(std::size_t bytes) {
  auto largest = largest_scan_.load();
  while (bytes > largest && !largest_scan_.compare_exchange_weak(largest, bytes)) {
  }
}

Result<std::filesystem::path> ResultStore::put(const std::string& id,
                                               const ResultContent& content) {
  if (!is_scan_id(id)) {
    return fail(ErrorCode::kInvalidInput, "\"" + id + "\" is not the id of a scan", "");
  }
  const std::shared_lock nobody_clears(clearing_);
  if (const auto there = check_root(); !there) return tl::make_unexpected(there.error());
  const auto day = root() / day_folder(id);
  const auto writing = day / (kWriting + id);
  bool is_named = false;
  const auto stored = make_day_folder(id)
                          .and_then([&] { return storage_->make_folder(writing); })
                          .and_then([&] { return write_files(writing, content); })
                          .and_then([&] { return storage_->sync_folder(writing); })
                          .and_then([&] { return storage_->rename(writing, day / id); })
                          .and_then([&] {
                            is_named = true;
                            return storage_->sync_folder(day);
                          });
  if (!stored) {
    // The failure to report is the first one, not that of clearing up after it.
    (void)(is_named ? move_away(id) : remove_whole(*storage_, writing));
    return tl::make_unexpected(stored.error());
  }
  note_stored(id);
  return day / id;
}

Result<void> ResultStore::make_day_folder(const std::string& id) {
  std::filesystem::path folder = root();
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
  return write_file(*storage_, folder / "result.json", content.result_json)
      .and_then([&] { return write_file(*storage_, folder / "cloud.ply", content.cloud_ply); })
      .and_then(
          [&] { return write_file(*storage_, folder / "sections.svg", content.sections_svg); })
      .and_then([&] { return write_file(*storage_, folder / "report.svg", content.report_svg); });
}

Result<std::vector<std::filesystem::path>> ResultStore::days() const {
  std::vector<std::filesystem::path> level = {root()};
  for (const std::size_t digits : {4U, 2U, 2U}) {
    std::vector<std::filesystem::path> below;
    for (const auto& folder : level) {
      const auto entries = storage_->list(folder);
      if (!entries && folder == root()) return tl::make_unexpected(entries.error());
      if (!entries) continue;
      for (const auto& entry : *entries) {
        const bool leads_on = entry.is_folder || entry.is_link_to_folder;
        if (leads_on && is_number(entry.name, digits)) below.push_back(folder / entry.name);
      }
    }
    level = std::move(below);
  }
  return level;
}

Result<std::vector<std::string>> ResultStore::list(const OnDay& on_day) const {
  const auto all_days = days();
  if (!all_days) return tl::make_unexpected(all_days.error());
  std::vector<std::string> ids;
  for (const auto& day : *all_days) {
    on_day();
    const auto of_day = ids_of(day);
    ids.insert(ids.end(), of_day.begin(), of_day.end());
  }
  std::reverse(ids.begin(), ids.end());
  return ids;
}

std::vector<std::string> ResultStore::ids_of(const std::filesystem::path& day) const {
  std::vector<std::string> ids;
  const auto entries = storage_->list(day);
  if (!entries) return ids;
  for (const auto& entry : *entries) {
    const bool is_result =
        entry.is_folder && is_scan_id(entry.name) && root() / day_folder(entry.name) == day;
    if (is_result) ids.push_back(entry.name);
  }
  return ids;
}

Result<std::string> ResultStore::find(const std::string& id,
                                      std::chrono::system_clock::time_point now) const {
  if (id == "latest") return find_latest(now);
  if (!is_scan_id(id)) {
    return fail(ErrorCode::kInvalidInput, "\"" + id + "\" is not the id of a scan",
                "instep list shows them");
  }
  const auto entries = storage_->list(root() / day_folder(id));
  if (!entries && entries.error().code != ErrorCode::kNotFound) {
    return tl::make_unexpected(entries.error());
  }
  const auto is_it = [&](const Storage::Entry& entry) {
    return entry.is_folder && entry.name == id;
  };
  if (entries && std::any_of(entries->begin(), entries->end(), is_it)) return id;
  return fail(ErrorCode::kNotFound, "there is no scan " + id, "instep list shows those there are");
}

Result<std::string> ResultStore::find_latest(std::chrono::system_clock::time_point now) const {
  if (auto last = last_stored(); !last.empty()) return last;
  auto latest = newest(now);
  if (latest && latest->empty()) {
    return fail(ErrorCode::kNotFound, "there is no scan yet", "make one: instep scan");
  }
  return latest;
}

Result<std::string> ResultStore::newest(std::chrono::system_clock::time_point now) const {
  const auto all_days = days();
  if (!all_days) return tl::make_unexpected(all_days.error());
  std::string dated_later;
  for (auto day = all_days->rbegin(); day != all_days->rend(); ++day) {
    const auto ids = ids_of(*day);
    for (auto id = ids.rbegin(); id != ids.rend(); ++id) {
      if (!is_made_later(*id, now)) return *id;
      if (dated_later.empty()) dated_later = *id;
    }
  }
  return dated_later;
}

void ResultStore::find_newest() {
  const auto found = newest(std::chrono::system_clock::now());
  const std::lock_guard lock(mutex_);
  newest_found_ = found.value_or("");
}

std::chrono::system_clock::time_point ResultStore::time_of_next(
    std::chrono::system_clock::time_point now) const {
  const std::lock_guard lock(mutex_);
  auto next = now;
  const auto come_after = [&](const std::string& id) {
    const auto time = time_of_scan_id(id);
    if (time && !is_made_later(id, now))
      next = std::max(next, *time + std::chrono::milliseconds(1));
  };
  come_after(newest_found_);
  for (const auto& id : stored_) come_after(id);
  return next;
}

std::string ResultStore::last_stored() const {
  std::unique_lock lock(mutex_);
  const auto stored = stored_;
  lock.unlock();
  // Another program may have removed it.
  const auto last = std::find_if(stored.rbegin(), stored.rend(),
                                 [&](const std::string& id) { return find(id).has_value(); });
  return last == stored.rend() ? "" : *last;
}

void ResultStore::note_stored(const std::string& id) {
  const std::lock_guard lock(mutex_);
  stored_.push_back(id);
  if (stored_.size() > kRemembered) stored_.pop_front();
}

void ResultStore::forget_stored(const std::string& id) {
  const std::lock_guard lock(mutex_);
  std::erase(stored_, id);
}

std::filesystem::path ResultStore::folder_of(const std::string& id) const {
  return root() / day_folder(id) / id;
}

Result<std::string> ResultStore::read_result_json(const std::string& id) const {
  return storage_->read(folder_of(id) / "result.json", kLargestResultJson);
}

Result<void> ResultStore::remove(const std::string& id) {
  const std::shared_lock nobody_clears(clearing_);
  return check_root().and_then([&] { return find(id); }).and_then([&](const std::string& found) {
    return move_away(found);
  });
}

Result<void> ResultStore::move_away(const std::string& id) {
  const auto day = root() / day_folder(id);
  const auto deleting = day / (kDeleting + id);
  return check_root()
      .and_then([&] { return storage_->rename(day / id, deleting); })
      .and_then([&] {
        forget_stored(id);
        return storage_->sync_folder(day);
      })
      .and_then([&] { return remove_whole(*storage_, deleting); });
}

Swept ResultStore::sweep(const Retention& retention, std::chrono::system_clock::time_point now,
                         const GoOn& go_on, const OnDay& on_day) {
  Swept swept;
  if (retention.keep_days == 0 && retention.keep_count == 0) return swept;
  const auto ids = check_root().and_then([&] { return list(on_day); });
  if (!ids) {
    swept.root_trouble = ids.error();
    return swept;
  }
  const auto gone = expired(*ids, retention, now, last_stored());
  swept.made_later = gone.made_later;
  swept.made_before_all = gone.made_before_all;
  for (const auto& id : gone.ids) {
    if (!go_on()) {
      swept.is_interrupted = true;
      return swept;
    }
    if (const auto removed = move_away(id); removed) {
      ++swept.removed;
    } else {
      keep_first(removed.error(), swept.trouble);
    }
  }
  return swept;
}

}  // namespace instep
