#pragma once

#include <Eigen/Core>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"
#include "daemon/report/svg_text.h"

namespace instep {

/// The foot from above, heel to the left, as SVG elements: its points, its tapes, its ball and its
/// length. `corner` is the left upper corner of the picture on the page, `size` the most that the
/// foot takes, without its length below; in pixels.
svg::Block plan_drawing(const FootScan& foot, const MeasureSet& measures,
                        const Eigen::Vector2d& corner, const Eigen::Vector2d& size);

}  // namespace instep
