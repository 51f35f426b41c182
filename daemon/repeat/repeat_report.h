#pragma once

#include <string>

#include "daemon/repeat/repeat_study.h"
#include "daemon/report/json_number.h"

namespace instep {

/// {"feet": [{"side", "n", "scans", "measures"}], "warnings"}. Each measure: `id`, `n`, `mean_mm`,
/// `sd_mm`, `range_mm`, `mean_absolute_difference_mm`, `least_mm`, `greatest_mm`, `claimed_u95_mm`,
/// `values_mm`; with `_deg` for an angle.
Json repeat_json(const RepeatStudy& study);

/// The same as a table for each foot, and what to doubt.
std::string repeat_text(const RepeatStudy& study);

}  // namespace instep
