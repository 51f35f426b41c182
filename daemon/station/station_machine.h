#pragma once

#include <cstdint>
#include <vector>

namespace instep {

/// What the station is at, as it is shown.
enum class StationState {
  kStarting,  ///< the cameras have not answered yet, or nobody knows of the pedal
  kReady,     ///< waits for the pedal
  kCapturing,
  kMeasuring,
  kStoring,
  kDegraded,  ///< a camera is away; the daemon tries to get it back and scans wait until then
  kFault,     ///< a person has to do something; scanning is tried all the same if cameras are there
};

const char* to_string(StationState state);

enum class StationEvent {
  kCamerasReady,     ///< every camera answered
  kCamerasLost,      ///< at least one did not
  kPedalReady,       ///< the pedal is there and not pressed, or none is wanted
  kPedalFault,       ///< stuck, unplugged or silent
  kScanRequested,    ///< the pedal was pressed, or somebody asked over the socket
  kCancelRequested,  ///< the pedal was held, or somebody asked
  kCaptured,
  kMeasured,
  kStored,         ///< the results are durable
  kScanFailed,     ///< while capturing or measuring
  kStoreFailed,    ///< results cannot be written: found at start-up, or while storing
  kStoreReady,     ///< results can be written again
  kScanCancelled,  ///< the scan has ended on request
  kShutdown,
};

/// What is to be done now, in order.
enum class StationAction {
  kStartScan,
  kCancelScan,
  kRefuseScan,   ///< no camera to scan with: say why
  kIgnorePress,  ///< one scan at a time: count it
  kAnnounceResult,
  kAnnounceFailure,
  kAnnounceCancelled,
  kLeave,  ///< nothing runs any more: the daemon can end
};

/// The rules of the station, with no clock and no input or output: events in, actions out. An event
/// that makes no sense in a state changes nothing. Not thread-safe; lives on the event loop.
class StationMachine {
 public:
  StationState state() const;
  std::uint64_t ignored_presses() const { return ignored_presses_; }
  bool is_busy() const { return phase_ >= Phase::kCapturing; }
  bool is_leaving() const { return leaving_; }
  /// Whether anything was told of the pedal. Until then a press would be lost.
  bool knows_pedal() const { return pedal_known_; }

  std::vector<StationAction> handle(StationEvent event);

 private:
  enum class Phase { kStarting, kIdle, kCapturing, kMeasuring, kStoring };

  std::vector<StationAction> cameras_answered(bool all);
  std::vector<StationAction> pedal_answered(bool well);
  std::vector<StationAction> scan_requested();
  std::vector<StationAction> cancel_requested();
  std::vector<StationAction> shut_down();
  std::vector<StationAction> advance(Phase from, Phase to);
  /// Ends the scan if one is under way.
  std::vector<StationAction> end_scan(std::vector<StationAction> actions);

  Phase phase_ = Phase::kStarting;
  bool cameras_lost_ = false;
  bool pedal_known_ = false;
  bool pedal_fault_ = false;
  bool store_fault_ = false;
  bool cancelling_ = false;
  bool leaving_ = false;
  std::uint64_t ignored_presses_ = 0;
};

}  // namespace instep
