#pragma once

#include <string>

#include "daemon/scan/scan_record.h"

namespace instep {

/// A scan on one page to print: A4, an SVG file that needs nothing outside. Views from above and
/// from the medial side with tapes and landmarks, the measures with their intervals, sizes of
/// shoes, the section of each girth, what was withheld and why, and a ruler that shows whether the
/// page was printed to scale.
///
/// `origin` says below the title what was measured: a file's name; the id, station and time of a
/// scan are added if it has an id. Cost: some milliseconds.
std::string report_page(const ScanRecord& record, const std::string& origin = {});

}  // namespace instep
