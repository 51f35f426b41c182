#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "config/settings.h"
#include "core/result.h"
#include "daemon/loop/event_loop.h"
#include "daemon/loop/task_thread.h"
#include "daemon/service/clock_watch.h"
#include "daemon/service/log.h"
#include "daemon/station/back_off.h"
#include "daemon/station/station.h"
#include "daemon/store/result_store.h"

namespace instep {

/// Of a store whose disk hangs.
Error silent_store();
/// Whether there is no such result; of a store whose disk was taken away nobody can tell.
bool is_missing(ResultStore& store, const std::string& id);

/// Looks after the store of a station: prepares it, sees whether results can be stored, again and
/// again, and removes old ones. Does so on the archive's thread, as its disk may be one that hangs,
/// and tells the station what is wrong. Lives on the loop's thread, as the station.
class StoreCare {
 public:
  using OnRemoved = std::function<void(const std::string& id)>;

  /// `last_removed` is told if the station's last result was removed.
  StoreCare(EventLoop& loop, Station& station, std::shared_ptr<ResultStore> store,
            TaskThread& archive, const StoreSettings& settings, OnRemoved last_removed);

  /// Prepares the store, and looks after it from then on.
  void begin();
  /// Sees now whether results can be stored.
  void look();
  /// Removes old results: every hour, when there is a new one, and when none can be stored.
  void sweep();
  /// How many results are kept from now on, and for how long.
  void set(const StoreSettings& settings) { settings_ = settings; }
  /// To be told of it: its store may have come to trouble, or out of it.
  void station_changed();
  /// Sweeps no further.
  void leave() { *leaving_ = true; }
  /// The archive is in the middle of a look or of the preparation, which an ailing disk holds up.
  bool is_looking() const { return looked_->load().count() != 0; }

 private:
  static constexpr std::chrono::seconds kFirstTrial{5};
  static constexpr std::chrono::seconds kLongestTrial{60};

  void was_prepared(const Result<Prepared>& prepared);
  /// If there is one: a look, or the preparation, hangs on a disk that does not answer.
  void tell_of_silent_store();
  /// In short parts, between which the archive answers those who ask.
  void sweep_part(std::size_t removed_before);
  void tell_of(const Swept& swept);

  EventLoop& loop_;
  Station& station_;
  std::shared_ptr<ResultStore> store_;
  TaskThread& archive_;
  StoreSettings settings_;
  OnRemoved last_removed_;
  ChangeLog said_;
  ClockWatch clock_{ClockWatch::read()};
  EventLoop::Timer look_timer_;
  EventLoop::Timer sweep_timer_;
  bool in_trouble_ = false;  ///< as station_changed() knows
  /// Then the store is tried out. Whoever makes room on a disk, or plugs it in again, waits to be
  /// told so; but to write as much as a scan all the time wears out a disk that stays full.
  BackOff trials_{kFirstTrial, kLongestTrial};
  bool is_looking_ = false;  ///< or is going to: one look at a time
  bool is_sweeping_ = false;
  bool sweeps_again_ = false;  ///< asked for while it was sweeping
  /// When the archive's thread made its last step in a look at the store, or in its preparation;
  /// zero while it is in the middle of neither.
  std::shared_ptr<std::atomic<std::chrono::nanoseconds>> looked_ =
      std::make_shared<std::atomic<std::chrono::nanoseconds>>(std::chrono::nanoseconds(0));
  std::shared_ptr<std::atomic<bool>> leaving_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace instep
