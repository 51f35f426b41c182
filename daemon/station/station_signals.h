#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/devices/output_settings.h"
#include "core/result.h"
#include "daemon/station/output_keeper.h"
#include "daemon/station/station_machine.h"

namespace instep {

/// One output, as the status tells it.
struct OutputStatus {
  std::string name;  ///< of its table in the settings, such as "lamp.ready"
  bool on = false;   ///< as it is wanted
  std::optional<Error> trouble{};
};

/// What the station shows to those around it, and lights: its lamps and the projector, each a
/// matter of the state alone. Whether they are there makes no difference to a scan.
class StationSignals {
 public:
  using Open = std::function<Result<std::unique_ptr<OutputLine>>(const GpioOutputSettings&)>;

  /// `on_change`: status() tells of another trouble. The loop and the keepers: as OutputKeeper.
  StationSignals(EventLoop& loop, const OutputSettings& outputs, const Open& open,
                 const std::function<void()>& on_change, const OutputKeeper::Pace& pace = {});
  ~StationSignals();
  StationSignals(const StationSignals&) = delete;
  StationSignals& operator=(const StationSignals&) = delete;

  void show(StationState state);
  /// Begins to put all off at once, so that OutputKeeper::kLastMoment holds for all together.
  void put_off();
  /// Waits for that; false if one had to be left behind. No call but the destructor may follow.
  bool finish();
  std::vector<OutputStatus> status() const;
  /// Why the projector cannot be lit; nothing if it can, or if there is none.
  std::optional<Error> light_trouble() const;

 private:
  struct Signal {
    std::string name;
    bool (*is_on)(StationState state);
    std::unique_ptr<OutputKeeper> keeper;
  };

  std::vector<Signal> signals_;
};

}  // namespace instep
