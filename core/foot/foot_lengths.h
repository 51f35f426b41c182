#pragma once

#include "core/foot/foot_scan.h"
#include "core/result.h"

namespace instep {

/// Straight measures of an aligned foot with its landmarks, in millimetres. Each fails with
/// kInsufficientData where the cloud has no points for it.

/// Pternion to the foremost toe, parallel to the axis.
Result<double> foot_length(const FootScan& foot);

/// Metatarsale tibiale to metatarsale fibulare, in floor projection.
Result<double> foot_breadth(const FootScan& foot);

/// Extent of the outline at right angles to the axis over the ball (0.5-0.85 of the length).
Result<double> foot_breadth_horizontal(const FootScan& foot);

}  // namespace instep
