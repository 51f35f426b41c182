#include "config/calibration/applied_calibration.h"

#include <fmt/format.h>

namespace instep {

std::string describe(const AppliedCalibration& calibration) {
  const std::string file = calibration.file.string();
  const auto& placed = calibration.placed;
  const auto& left_out = calibration.left_out;
  const auto& unknown = calibration.unknown;
  if (placed.empty() && left_out.empty()) {
    return fmt::format("poses    simulated and recorded cameras bring their own; {} is not used\n",
                       file);
  }
  std::string text =
      fmt::format("poses    {} as calibrated at {}, {}\n",
                  placed.empty() ? "no camera" : fmt::format("{}", fmt::join(placed, ", ")),
                  calibration.time, file);
  if (!left_out.empty()) {
    text +=
        fmt::format("poses    {} as the settings say, for want of calibration: instep calibrate\n",
                    fmt::join(left_out, ", "));
  }
  if (!unknown.empty()) {
    text += fmt::format("poses    of {} are calibrated too, but no [[camera]] is called so\n",
                        fmt::join(unknown, ", "));
  }
  return text;
}

std::string what_is_lacking(const AppliedCalibration& calibration) {
  if (calibration.left_out.empty()) return "";
  return fmt::format("{} does not hold {}", calibration.file.string(),
                     fmt::join(calibration.left_out, ", "));
}

}  // namespace instep
