#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/foot/shoe_sizes.h"
#include "daemon/report/json_number.h"

namespace instep {

/// Sizes of shoes as `sizes` of a result holds them:
///
/// | key | what it is |
/// |---|---|
/// | `mondopoint_mm`, `mondopoint_width_mm` | ISO 9407: length and breadth of the foot |
/// | `eu`, `uk`, `us_men`, `us_women` | to the nearest half; unrounded under `exact` |
/// | `jis_men`, `jis_women` | JIS S 5037: length in cm and the letter of the ball girth |
/// | `allowance_mm` | what the last is longer than the foot, in `eu` and `uk` |
/// | `shop` | the shop's own tables: `table`, `size` (null if none fits), `note` |
/// | `notes` | what is missing and why |
/// | `guide` | that it is one |
///
/// What a scale does not reach is left out.
Json sizes_json(const ShoeSizes& sizes);

/// The same in a line for the systems, one for each of the shop's tables, one for each note. Takes
/// what sizes_json() made; leaves out what is of another shape. Empty if there is nothing to say.
std::string sizes_text(const nlohmann::json& sizes);

}  // namespace instep
