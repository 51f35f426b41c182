#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "core/result.h"
#include "daemon/loop/event_loop.h"
#include "daemon/loop/progress_watch.h"
#include "daemon/loop/task_thread.h"
#include "daemon/station/back_off.h"
#include "daemon/station/camera_care.h"
#include "daemon/station/camera_looks.h"
#include "daemon/station/camera_set.h"
#include "daemon/station/devices.h"
#include "daemon/station/pedal_watch.h"
#include "daemon/station/scan_session.h"
#include "daemon/station/station_machine.h"
#include "daemon/station/station_signals.h"
#include "daemon/station/station_status.h"

namespace instep {

/// Told of what happens, on the loop's thread.
struct StationListener {
  std::function<void()> on_change;  ///< status() says something new
  std::function<void(const std::vector<StoredResult>&)> on_result;
  std::function<void(const Error&)>
      on_failure;  ///< a scan ended without a result, or was cancelled
  std::function<void(std::uint64_t ignored)> on_ignored_press;
  std::function<void()> on_left;  ///< after shut_down(): nothing runs any more
};

/// The station at work: joins the state machine to the cameras, the pedal, the scan's thread and
/// the store. Lives on the loop's thread, on which all calls are made; none of them waits.
class Station {
 public:
  /// `open` is called on the scan's thread, `opens_pedal` on the pedal's.
  Station(EventLoop& loop, Settings settings, MeasureCapture measure,
          std::shared_ptr<ResultStore> store, StationListener listener,
          OpenDevices open = open_devices_at_last(), OpenPedal opens_pedal = open_pedal);
  ~Station();

  /// Opens the devices; on_change tells how that goes.
  void begin();
  /// Results cannot be written, as was found beside the scans: what one meets that is being stored
  /// it tells itself.
  void store_failed(const Error& error);
  /// Which trouble of the store lasts, for store_tried_out(); nothing if there is none.
  std::optional<std::uint64_t> store_trouble() const;
  /// What came of trying out the store for that trouble; passed over if it failed again since.
  void store_tried_out(std::uint64_t trouble, const Result<void>& outcome);

  /// As the pedal does. Fails with kBusy while a scan runs, or with the camera's trouble.
  Result<void> request_scan();
  /// Fails with kNotFound if no scan runs that can be cancelled.
  Result<void> request_cancel();
  /// Takes over what can change while running: station, capture, measures, sizes, the pedal's
  /// times. Looks at the cameras by them.
  void reload(const Settings& settings);
  /// Ends a scan that runs; on_left follows.
  void shut_down();
  /// Puts lamps and the projector off and waits for all threads, after the loop has ended. Returns
  /// what hangs and had to be left behind, which goes on with what it uses. No call but the
  /// destructor may follow.
  std::vector<std::string> end_by(std::chrono::steady_clock::time_point deadline);

  /// That result was removed: it is not the last one any more.
  void forget_result(const std::string& id);

  StationState state() const { return machine_.state(); }
  StationStatus status() const;
  void note_progress(ProgressWatch& watch) const;

 private:
  void handle(StationEvent event);
  void act(StationAction action);
  void open_devices_again();
  void take_devices(OpenedDevices devices);
  void begin_care();
  void cameras_looked_at();
  void pedal_signalled(PedalSignal signal);
  void pedal_lost(const Error& error);
  void pedal_returned();
  void start_scan();
  /// A projector that is away fails no scan, but its frames are the poorer for it.
  void remark_missing_light();
  /// Nor do cameras that are not where a calibration found them, whatever comes of their poses.
  void remark_poses();
  std::vector<std::string> pose_warnings(const std::vector<CameraStatus>& cameras) const;
  std::vector<CameraStatus> camera_status() const;
  void scan_ended(const ScanOutcome& outcome);
  void note_store_failure(const Error& error);
  ScanTools tools() const;
  std::vector<StationTrouble> troubles(const std::vector<CameraStatus>& cameras) const;
  /// Why a scan cannot begin now.
  Error refusal() const;

  EventLoop& loop_;
  Settings settings_;
  MeasureCapture measure_;
  std::shared_ptr<ResultStore> store_;
  StationListener listener_;
  OpenDevices open_devices_;
  OpenPedal open_pedal_;
  StationMachine machine_;

  std::optional<StationSignals> signals_;
  std::optional<PedalWatch> pedal_;
  std::optional<Error> pedal_trouble_;
  std::optional<Error> store_trouble_;
  std::uint64_t store_failures_ = 0;
  std::vector<SourceTrouble> opening_troubles_;

  Devices devices_;  ///< without its cameras, which the set owns
  std::shared_future<std::map<std::string, double>> truth_;
  std::shared_ptr<CameraSet> cameras_;
  std::optional<CameraCare> care_;    ///< there with cameras_
  std::optional<CameraLooks> looks_;  ///< there with cameras_
  EventLoop::Timer open_timer_;
  BackOff open_back_off_;

  TaskThread truth_thread_{"truth"};
  TaskThread scan_thread_{"scan"};
  std::shared_ptr<std::atomic<bool>> cancelled_;
  std::shared_ptr<CaptureRemarks> remarks_;  ///< of the last scan that began
  ScanOutcome outcome_;
  std::string stage_;
  double done_ = 0.0;
  std::uint64_t scans_ = 0;
  std::string last_result_;
  bool opening_ = false;
};

}  // namespace instep
