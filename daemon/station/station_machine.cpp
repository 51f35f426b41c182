#include "daemon/station/station_machine.h"

namespace instep {

using Actions = std::vector<StationAction>;

const char* to_string(StationState state) {
  switch (state) {
    case StationState::kStarting:
      return "starting";
    case StationState::kReady:
      return "ready";
    case StationState::kCapturing:
      return "capturing";
    case StationState::kMeasuring:
      return "measuring";
    case StationState::kStoring:
      return "storing";
    case StationState::kDegraded:
      return "degraded";
    case StationState::kFault:
      return "fault";
  }
  return "fault";
}

StationState StationMachine::state() const {
  switch (phase_) {
    case Phase::kStarting:
      return StationState::kStarting;
    case Phase::kCapturing:
      return StationState::kCapturing;
    case Phase::kMeasuring:
      return StationState::kMeasuring;
    case Phase::kStoring:
      return StationState::kStoring;
    case Phase::kIdle:
      break;
  }
  if (!pedal_known_) return StationState::kStarting;
  if (pedal_fault_ || store_fault_) return StationState::kFault;
  return cameras_lost_ ? StationState::kDegraded : StationState::kReady;
}

Actions StationMachine::handle(StationEvent event) {
  switch (event) {
    case StationEvent::kCamerasReady:
      return cameras_answered(true);
    case StationEvent::kCamerasLost:
      return cameras_answered(false);
    case StationEvent::kPedalReady:
      return pedal_answered(true);
    case StationEvent::kPedalFault:
      return pedal_answered(false);
    case StationEvent::kScanRequested:
      return scan_requested();
    case StationEvent::kCancelRequested:
      return cancel_requested();
    case StationEvent::kCaptured:
      return advance(Phase::kCapturing, Phase::kMeasuring);
    case StationEvent::kMeasured:
      return advance(Phase::kMeasuring, Phase::kStoring);
    case StationEvent::kStored:
      if (phase_ != Phase::kStoring) return {};
      store_fault_ = false;
      return end_scan({StationAction::kAnnounceResult});
    case StationEvent::kStoreFailed:
      store_fault_ = true;
      if (phase_ != Phase::kStoring) return {};
      return end_scan({StationAction::kAnnounceFailure});
    case StationEvent::kStoreReady:
      store_fault_ = false;
      return {};
    case StationEvent::kScanFailed:
      return end_scan({StationAction::kAnnounceFailure});
    case StationEvent::kScanCancelled:
      return end_scan({StationAction::kAnnounceCancelled});
    case StationEvent::kShutdown:
      return shut_down();
  }
  return {};
}

Actions StationMachine::cameras_answered(bool all) {
  cameras_lost_ = !all;
  if (phase_ == Phase::kStarting) phase_ = Phase::kIdle;
  return {};
}

Actions StationMachine::pedal_answered(bool well) {
  pedal_known_ = true;
  pedal_fault_ = !well;
  return {};
}

Actions StationMachine::scan_requested() {
  if (is_busy()) {
    ++ignored_presses_;
    return {StationAction::kIgnorePress};
  }
  if (phase_ == Phase::kStarting || cameras_lost_ || leaving_) return {StationAction::kRefuseScan};
  phase_ = Phase::kCapturing;
  return {StationAction::kStartScan};
}

Actions StationMachine::cancel_requested() {
  // Storing takes a moment and is not given up half-way.
  if (!is_busy() || phase_ == Phase::kStoring || cancelling_) return {};
  cancelling_ = true;
  return {StationAction::kCancelScan};
}

Actions StationMachine::shut_down() {
  if (leaving_) return {};
  leaving_ = true;
  return is_busy() ? cancel_requested() : Actions{StationAction::kLeave};
}

Actions StationMachine::advance(Phase from, Phase to) {
  if (phase_ == from) phase_ = to;
  return {};
}

Actions StationMachine::end_scan(Actions actions) {
  if (!is_busy()) return {};
  phase_ = Phase::kIdle;
  cancelling_ = false;
  if (leaving_) actions.push_back(StationAction::kLeave);
  return actions;
}

}  // namespace instep
