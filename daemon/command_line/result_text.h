#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace instep {

/// What a person reads of a result: one line a measure, with its 95 % interval, and beside it the
/// truth and the error where the scan was simulated. Takes what result.json holds; what is missing
/// there is left out.
std::string result_text(const nlohmann::json& result);

}  // namespace instep
