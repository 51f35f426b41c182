#pragma once

#include <string>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"

namespace instep {

/// A page that shows what was measured and where (a whole SVG file, nothing outside needed): the
/// foot from above with its tapes, and the section of each girth, all sections to one scale, with
/// the points of the cloud, the skin, the stretched tape and the number.
std::string sections_svg(const FootScan& foot, const MeasureSet& measures);

}  // namespace instep
