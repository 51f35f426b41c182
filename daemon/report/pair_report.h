#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "daemon/report/json_number.h"
#include "daemon/scan/scan_record.h"

namespace instep {

/// Both feet of a scan, as `pair` of a result holds them:
///
/// | key | what it is |
/// |---|---|
/// | `left`, `right` | ids of the two scans |
/// | `leads` | "left" or "right": the longer foot; null where that cannot be told |
/// | `measures` | `id`, `left_mm`, `right_mm`, `difference_mm` (right less left), `u95_mm` of the |
/// | | difference, `larger` (null: within the interval, or equal) |
/// | `of_one_foot` | ids of the measures that only one foot has |
/// | `sizes` | as sizes_json(): of each measure the larger one |
Json pair_json(const ScannedPair& pair);

/// The same as a table. Takes what pair_json() made; leaves out what is of another shape. Empty if
/// there is no pair.
std::string pair_text(const nlohmann::json& pair);

}  // namespace instep
