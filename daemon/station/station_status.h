#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "daemon/station/camera_care.h"
#include "daemon/station/frame_tally.h"
#include "daemon/station/station_machine.h"
#include "daemon/station/station_signals.h"

namespace instep {

struct CameraStatus {
  std::string id;
  std::string model;
  std::string serial{};            ///< as the camera itself tells it; empty if it does not
  std::optional<Error> trouble{};  ///< nothing = it answers
  CameraHealth health{};
  FrameCounts frames{};
};

struct PedalStatus {
  std::optional<Error> trouble;
};

struct StoreStatus {
  std::filesystem::path root;  ///< where results go, whatever the settings have come to say since
  std::optional<Error> trouble;
};

/// What is wrong and what to do.
struct StationTrouble {
  Error error;
  std::string camera{};  ///< if it is one's
};

/// All that is told of a station from outside.
struct StationStatus {
  StationState state = StationState::kStarting;
  std::vector<StationTrouble> troubles;  ///< of cameras, store, pedal
  std::vector<std::string> warnings;  ///< what spoils measures or holds up a scan, and stops none
  std::string stage;                  ///< of the scan that runs; empty if none does
  double done = 0.0;                  ///< of that scan, 0 to 1
  std::vector<CameraStatus> cameras;
  std::optional<PedalStatus> pedal;  ///< nothing = there is to be none
  StoreStatus store;
  std::vector<OutputStatus> outputs;  ///< lamps and the projector
  std::uint64_t scans = 0;            ///< that ended with a result, since the daemon started
  std::uint64_t ignored_presses = 0;
  /// Id; empty if there was none since the daemon started, or it was removed.
  std::string last_result;

  /// The first, in a line; empty if nothing is wrong.
  std::string trouble() const { return troubles.empty() ? "" : troubles.front().error.line(); }
};

}  // namespace instep
