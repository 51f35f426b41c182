#pragma once

#include <string>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"
#include "core/foot/shoe_sizes.h"
#include "core/girth/girth.h"
#include "daemon/report/json_number.h"
#include "daemon/scan/scan_record.h"

namespace instep {

/// Lengths are rounded to 0.001 mm, those of a single girth to 0.000001 mm; what is no finite
/// number is null.

/// Milliseconds that `instep girth` took, by stage.
struct GirthTimes {
  double read_ms = 0.0;
  double measure_ms = 0.0;
  double total_ms = 0.0;
};

/// One girth, as `instep girth` prints it. `method` is the name that the user gave.
Json girth_json(const std::string& method, const Girth& girth, const GirthTimes& times);

/// A measured foot, as `instep measure` prints it: side, frame, landmarks (each with `u95_mm`, the
/// radius within which it is), measures (an angle has `value_deg` and `u95_deg` instead of
/// `value_mm` and `u95_mm`; `surface_u95_mm` and `landmarks_u95_mm` are the two parts of the
/// interval, which add as squares), those that were withheld and why, sizes, warnings.
Json foot_json(const FootScan& foot, const MeasureSet& measures, const ShoeSizes& sizes);

/// A whole result, as result.json holds it: what came how and when, then the object of foot_json(),
/// then `pair` (pair_json()) if both feet were scanned together, and `truth` (measure id -> value)
/// if the scan was simulated.
Json result_json(const ScanRecord& record);

}  // namespace instep
