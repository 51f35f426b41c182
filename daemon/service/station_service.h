#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "config/settings.h"
#include "core/result.h"
#include "daemon/control/control_server.h"
#include "daemon/loop/event_loop.h"
#include "daemon/loop/progress_watch.h"
#include "daemon/loop/task_thread.h"
#include "daemon/service/clock_watch.h"
#include "daemon/service/log.h"
#include "daemon/service/service_manager.h"
#include "daemon/station/back_off.h"
#include "daemon/station/station.h"
#include "daemon/store/result_store.h"

namespace instep {

/// The daemon: the station, its store and its socket on one event loop, under systemd's eyes.
/// SIGTERM and SIGINT end it within a second, SIGHUP reads the settings again; these signals must
/// be blocked before.
class StationService {
 public:
  /// Reads the settings anew, for SIGHUP.
  using ReadSettings = std::function<Result<Settings>()>;

  /// Fails if the socket or the event loop cannot be had; a store or a camera that is not there is
  /// the station's trouble and no failure.
  static Result<std::unique_ptr<StationService>> create(Settings settings,
                                                        ReadSettings read_settings,
                                                        MeasureCapture measure);
  ~StationService();

  /// Until it is told to end. False if a thread had to be left behind in the middle of something;
  /// the process has to end at once then, and tear down nothing that the thread may still use.
  Result<bool> run();

 private:
  static constexpr std::chrono::seconds kFirstTrial{5};
  static constexpr std::chrono::seconds kLongestTrial{60};

  StationService(Settings settings, ReadSettings read_settings);
  Result<void> open(MeasureCapture measure);
  /// On the archive's thread, as its disk may be one that hangs.
  void prepare_store();
  void store_prepared(const Result<Prepared>& prepared);
  void station_changed();
  void scan_succeeded(const std::vector<StoredResult>& results);
  void scan_failed(const Error& error);
  void serve(ControlServer::Client client, const Request& request);
  void begin_to_watch(ControlServer::Client client);
  void serve_from_store(ControlServer::Client client, const Request& request);
  /// Sees whether results can be stored, again and again.
  void look_at_store();
  /// If there is one: a look, or the preparation, hangs on a disk that does not answer.
  void tell_of_silent_store();
  void store_trouble_changed();
  void storing_takes_long();
  /// Removes old results: every hour, when there is a new one, and when none can be stored.
  void sweep_store();
  /// In short parts, between which the archive answers those who ask.
  void sweep_part(std::size_t removed_before);
  void tell_of(const Swept& swept);
  void forget_result(const std::string& id);
  void reload();
  void shut_down();
  void feed_watchdog();
  /// False if something had to be left behind.
  bool end_threads();
  /// The station's, and what is wrong with its settings.
  StationStatus status() const;
  std::string text_of(const StationStatus& now) const;

  Settings settings_;
  ReadSettings read_settings_;
  std::unique_ptr<EventLoop> loop_;
  ServiceManager manager_;
  ChangeLog said_;
  std::string settings_fault_;  ///< of those that were read last; empty if they are in use
  std::shared_ptr<ResultStore> store_;
  std::unique_ptr<TaskThread> archive_;
  std::unique_ptr<ControlServer> server_;
  std::unique_ptr<Station> station_;
  LastingLines troubles_;
  LastingLines warnings_;
  std::string last_result_event_;
  std::chrono::nanoseconds last_result_time_{0};
  ProgressWatch progress_;
  bool store_in_trouble_ = false;  ///< as station_changed() knows
  /// Then the store is tried out. Whoever makes room on a disk, or plugs it in again, waits to be
  /// told so; but to write as much as a scan all the time wears out a disk that stays full.
  BackOff store_trials_{kFirstTrial, kLongestTrial};
  bool storing_takes_long_ = false;   ///< that of the scan which is being stored
  bool is_looking_at_store_ = false;  ///< or is going to: one look at a time
  bool is_sweeping_ = false;
  bool sweeps_again_ = false;  ///< asked for while it was sweeping
  ClockWatch clock_{ClockWatch::read()};
  EventLoop::Timer store_timer_;
  EventLoop::Timer storing_timer_;
  EventLoop::Timer sweep_timer_;
  EventLoop::Timer watchdog_timer_;
  EventLoop::Timer shutdown_timer_;
  /// When the archive's thread made its last step in a look at the store, or in its preparation;
  /// zero while it is in the middle of neither.
  std::shared_ptr<std::atomic<std::chrono::nanoseconds>> archive_looked_ =
      std::make_shared<std::atomic<std::chrono::nanoseconds>>(std::chrono::nanoseconds(0));
  std::shared_ptr<std::atomic<bool>> leaving_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace instep
