#pragma once

#include <string>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"

namespace instep {

/// The measures as CSV (RFC 4180 but for plain newlines): a header, then a line for each measure.
/// `u95_mm` and `contact_mm` are empty where there is none. A point is the decimal mark in every
/// locale.
std::string foot_csv(const FootScan& foot, const MeasureSet& measures);

}  // namespace instep
