#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>
#include <vector>

#include "core/go_on.h"
#include "core/result.h"
#include "daemon/store/result_content.h"
#include "daemon/store/retention.h"
#include "daemon/store/storage.h"
#include "daemon/store/store_root.h"

namespace instep {

/// What was found of earlier runs.
struct Prepared {
  std::size_t cleared = 0;  ///< results that were half made or half deleted, and are gone now
  /// Another program works on the same results: what it has half made is not cleared.
  bool is_shared = false;
  std::optional<Error> trouble;  ///< the first, of a leftover that cannot be cleared
};

/// What a sweep did.
struct Swept {
  std::size_t removed = 0;
  std::size_t made_later = 0;  ///< see Expired
  std::size_t made_before_all = 0;
  bool is_interrupted = false;        ///< by its `go_on`: more may have to go
  std::optional<Error> trouble;       ///< the first, of a result that cannot be removed
  std::optional<Error> root_trouble;  ///< nothing was looked at
};

/// The results on disk: <root>/YYYY/MM/DD/<id>/ with result.json, cloud.ply, sections.svg and
/// report.svg.
///
/// A result appears whole or not at all, whatever fails and whenever the power goes: it is written
/// under a temporary name in the folder where it will lie, each file and the folder are flushed,
/// then it is renamed, and the folder above is flushed. A result that put() has reported is
/// durable.
///
/// Of what is not on the disk it knows but what it has stored itself, in that order: a clock that
/// was set back makes no earlier scan the latest. Safe from many threads.
class ResultStore {
 public:
  ResultStore(std::shared_ptr<Storage> storage, std::filesystem::path root);

  const std::filesystem::path& root() const { return root_.path(); }

  /// Called before the folder of each day is read, so that who counts the calls can tell many
  /// folders on a slow disk from a disk that hangs.
  using OnDay = std::function<void()>;

  /// Takes the root, see StoreRoot, and clears what an earlier run left half-done, unless another
  /// program works on the same results. Reads the folders of all days. Nothing else but expect(),
  /// time_of_next(), put() and remove() may come from another thread meanwhile: the last two wait
  /// until the root is taken, and then for the clearing of one day at most. Until the root is taken
  /// time_of_next() knows of no earlier run.
  Result<Prepared> prepare(const OnDay& on_day = [] {});

  /// Whether the root is the one that prepare() took: see StoreRoot. What puts or takes away
  /// results fails if not, so that nothing is put on the disk beneath nor taken from a foreign one.
  Result<void> check_root();

  /// Whether a result could be stored now: writes, flushes and removes a file as large as the
  /// largest scan so far in the folder of today, where the next one will lie; it is none. Makes up
  /// for a prepare() that failed, but for the clearing. For one thread at a time.
  Result<void> try_out(
      std::chrono::system_clock::time_point now = std::chrono::system_clock::now());

  /// Tells how large all results of a scan are together, before they are put: for try_out().
  void expect(std::size_t bytes);

  /// Stores a result and returns its folder. On failure nothing is left but, if the cleaning up
  /// fails too, a leftover that prepare() clears.
  Result<std::filesystem::path> put(const std::string& id, const ResultContent& content);

  /// All ids, newest first; without those in folders that cannot be read. It reads the folders of
  /// all days: 0.3 s for 20,000 results.
  Result<std::vector<std::string>> list(const OnDay& on_day = [] {}) const;

  /// `id`, or if it is "latest" what was stored last; where this has stored none that is still
  /// there, the newest by `now`: one that a wrong clock dated later only if there is no other.
  /// Fails with kNotFound if there is none, and with kInvalidInput if `id` cannot be one. Looks at
  /// the folder of its day alone, and for the latest at the names of all days.
  Result<std::string> find(const std::string& id, std::chrono::system_clock::time_point now =
                                                      std::chrono::system_clock::now()) const;

  /// From when on ids sort behind those that were found when the root was taken and those that this
  /// has stored: `now`, or where the clock was set back a little, just after the newest. Looks at
  /// no disk.
  std::chrono::system_clock::time_point time_of_next(
      std::chrono::system_clock::time_point now) const;

  std::filesystem::path folder_of(const std::string& id) const;
  Result<std::string> read_result_json(const std::string& id) const;

  /// Takes the result away as a whole, with whatever else lies in its folder.
  Result<void> remove(const std::string& id);

  /// Removes what is too old or too many; what cannot be removed is passed over. Lists them all
  /// before, and then asks `go_on` before each that is to go.
  Swept sweep(
      const Retention& retention, std::chrono::system_clock::time_point now,
      const GoOn& go_on = always, const OnDay& on_day = [] {});

 private:
  Result<bool> take_root();
  Result<Prepared> clear_leftovers(const OnDay& on_day);
  void clear_day(const std::filesystem::path& day, Prepared& prepared);
  Result<void> make_day_folder(const std::string& id);
  Result<void> write_files(const std::filesystem::path& folder, const ResultContent& content);
  Result<void> move_away(const std::string& id);
  Result<std::string> find_latest(std::chrono::system_clock::time_point now) const;
  /// The newest by its id that is not dated later than `now`; else the newest; empty if there is
  /// none.
  Result<std::string> newest(std::chrono::system_clock::time_point now) const;
  /// Reads the disk, for time_of_next().
  void find_newest();
  /// Of what this has stored; empty if nothing is there any more.
  std::string last_stored() const;
  void note_stored(const std::string& id);
  void forget_stored(const std::string& id);
  /// The folders of all days, oldest first, that can be read.
  Result<std::vector<std::filesystem::path>> days() const;
  /// Oldest first; nothing of a day that cannot be read.
  std::vector<std::string> ids_of(const std::filesystem::path& day) const;

  std::shared_ptr<Storage> storage_;
  StoreRoot root_;
  /// What is being written or removed is no leftover. Those who do either share it. Who waits for
  /// it comes before the next day's clearing, which the standard does not promise but glibc does:
  /// who held it alone hands it over to those who wait to share it.
  std::shared_mutex clearing_;
  std::atomic<std::size_t> largest_scan_ = 0;  ///< in bytes; see expect()
  mutable std::mutex mutex_;                   ///< of what follows
  std::string newest_found_;  ///< by newest(), when the root was taken; empty if there was none
  std::deque<std::string> stored_;  ///< by this, and not removed by it since: the last ones
};

}  // namespace instep
