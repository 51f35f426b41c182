#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"

namespace instep {

/// The length of a foot, ready to be drawn between its ends.
struct DrawnLength {
  Eigen::Vector3d rear;
  Eigen::Vector3d front;
  std::string interval;  ///< in millimetres
};

/// Nothing where it was not measured, or where an end is missing or not finite.
std::optional<DrawnLength> draw_length(const FootScan& foot, const MeasureSet& measures);

}  // namespace instep
