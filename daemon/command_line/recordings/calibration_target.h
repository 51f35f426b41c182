#pragma once

#include <filesystem>

#include "config/calibration/calibration_file.h"
#include "core/result.h"

namespace instep {

/// Where found poses are to be written.
struct CalibrationTarget {
  std::filesystem::path file;
  bool is_of_station = false;  ///< the station takes the poses from there when it starts
};

/// Whether a calibration may be written there, to be asked before the work: the folder is there and
/// may be written in, and what has the name is nothing or a calibration. The station's own may be a
/// faulty one, or a link to one that is none or sound. Fails with what to do.
Result<void> check_calibration_target(const CalibrationTarget& target);

/// Writes it, whole or not at all; a new one of the station may be read by all, whoever calibrates.
/// Fails with kInvalidInput, before that, if it would not be read again (names that no settings
/// have), or with what write_file_bytes() says.
Result<void> write_calibration(const CalibrationTarget& target,
                               const StationCalibration& calibration);

}  // namespace instep
