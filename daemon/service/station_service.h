#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "core/result.h"
#include "daemon/control/control_server.h"
#include "daemon/loop/event_loop.h"
#include "daemon/loop/progress_watch.h"
#include "daemon/loop/task_thread.h"
#include "daemon/service/log.h"
#include "daemon/service/service_manager.h"
#include "daemon/service/store_care.h"
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
  StationService(Settings settings, ReadSettings read_settings);
  Result<void> open(MeasureCapture measure);
  void station_changed();
  void scan_succeeded(const std::vector<StoredResult>& results);
  void scan_failed(const Error& error);
  void serve(ControlServer::Client client, const Request& request);
  void begin_to_watch(ControlServer::Client client);
  void serve_from_store(ControlServer::Client client, const Request& request);
  void storing_takes_long();
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
  std::optional<StoreCare> store_care_;  ///< there with station_
  LastingThings troubles_;
  LastingThings warnings_;
  std::string last_result_event_;
  std::chrono::nanoseconds last_result_time_{0};
  ProgressWatch progress_;
  bool storing_takes_long_ = false;  ///< that of the scan which is being stored
  EventLoop::Timer storing_timer_;
  EventLoop::Timer watchdog_timer_;
  EventLoop::Timer shutdown_timer_;
  bool leaving_ = false;
};

}  // namespace instep
