#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace instep {

/// The measures of a result, as foot_json() or result.json holds them, as CSV (RFC 4180 but for
/// plain newlines): a header, then a line for each measure and each that was withheld. A cell is
/// empty where there is no number; `value_deg` is that of an angle, `definition`
/// the sentence by which the measure was taken along `axis`. A point is the decimal mark in
/// every locale. What is of another shape is left out.
std::string result_csv(const nlohmann::json& result);

}  // namespace instep
