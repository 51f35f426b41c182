#pragma once

#include <Eigen/Core>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"
#include "daemon/report/svg_text.h"

namespace instep {

/// The foot from above and from its medial side, both to one scale: relief, tapes (thin where the
/// foot hides them) with their names and lengths, length, landmarks with numbers and their names.
/// `corner` is the left upper one, in the units of paper.h.
svg::Block views_block(const FootScan& foot, const MeasureSet& measures,
                       const Eigen::Vector2d& corner, double width);

}  // namespace instep
