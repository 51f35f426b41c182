#include "daemon/station/station_signals.h"

namespace instep {
namespace {

bool is_ready(StationState state) {
  return state == StationState::kReady;
}

bool is_capturing(StationState state) {
  return state == StationState::kCapturing;
}

bool is_busy(StationState state) {
  return state == StationState::kStarting || is_capturing(state) ||
         state == StationState::kMeasuring || state == StationState::kStoring;
}

bool is_fault(StationState state) {
  return state == StationState::kDegraded || state == StationState::kFault;
}

}  // namespace

StationSignals::StationSignals(EventLoop& loop, const OutputSettings& outputs, const Open& open,
                               const std::function<void()>& on_change,
                               const OutputKeeper::Pace& pace) {
  const auto add = [&](const char* name, const std::optional<GpioOutputSettings>& output,
                       bool (*is_on)(StationState)) {
    if (!output) return;
    const auto open_it = [open, chosen = *output] { return open(chosen); };
    signals_.push_back(
        {name, is_on, std::make_unique<OutputKeeper>(loop, name, open_it, on_change, pace)});
  };
  add("lamp.ready", outputs.ready_lamp, is_ready);
  add("lamp.busy", outputs.busy_lamp, is_busy);
  add("lamp.fault", outputs.fault_lamp, is_fault);
  add("projector", outputs.projector, is_capturing);
}

StationSignals::~StationSignals() {
  finish();
}

void StationSignals::put_off() {
  for (const auto& signal : signals_) signal.keeper->put_off();
}

bool StationSignals::finish() {
  put_off();
  bool all_ended = true;
  for (const auto& signal : signals_) all_ended = signal.keeper->finish() && all_ended;
  return all_ended;
}

void StationSignals::show(StationState state) {
  for (const auto& signal : signals_) signal.keeper->set(signal.is_on(state));
}

std::vector<OutputStatus> StationSignals::status() const {
  std::vector<OutputStatus> all;
  for (const auto& [name, is_on, keeper] : signals_) {
    all.push_back({name, keeper->wanted(), keeper->trouble()});
  }
  return all;
}

std::optional<Error> StationSignals::light_trouble() const {
  for (const auto& signal : signals_) {
    if (signal.is_on == is_capturing) return signal.keeper->trouble();
  }
  return std::nullopt;
}

}  // namespace instep
