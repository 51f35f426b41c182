#pragma once

#include <nlohmann/json.hpp>
#include <optional>

namespace instep {

/// Results as JSON, with the keys in a fixed order.
using Json = nlohmann::ordered_json;

/// To a whole number of steps; zero has no sign.
double rounded_to(double value, double step);

/// A number rounded to `step`; null where it is missing or not finite, so that the text is always
/// valid JSON. Zero has no sign.
Json json_number(double value, double step = 0.001);
Json json_number(const std::optional<double>& value, double step = 0.001);

}  // namespace instep
