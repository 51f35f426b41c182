#pragma once

#include <string>

#include "daemon/repeat/repeat_study.h"

namespace instep {

/// A plot of a study as a whole SVG file of A4 width: a row for each measure, with the deviation of
/// each scan from their mean in the order of the scans, the band of one standard deviation, and the
/// figures. Lengths and angles have a scale each.
std::string repeat_svg(const RepeatStudy& study);

}  // namespace instep
