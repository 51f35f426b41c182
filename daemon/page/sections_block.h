#pragma once

#include <Eigen/Core>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"
#include "daemon/report/svg_text.h"

namespace instep {

/// The section of each girth, all to one scale, medial on the left: the points of the scan, the
/// skin, the stretched tape, and both lengths. As many in a row as fit; the scale is the largest at
/// which all rows end above `lowest`.
svg::Block sections_block(const FootScan& foot, const MeasureSet& measures,
                          const Eigen::Vector2d& corner, double width, double lowest);

}  // namespace instep
