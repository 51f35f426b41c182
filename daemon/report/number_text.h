#pragma once

#include <optional>
#include <string>

#include "core/foot/measure_set.h"

namespace instep {

/// "251.3": the tenths of a figure as a result keeps it, in thousandths, so that whatever shows it
/// rounds alike.
std::string tenths(double value);

/// The same of half of an interval, "0.1" at the least: no measure is told to be exact.
std::string interval_tenths(double u95);

/// "251.3", or "251.3 +- 0.2" with a true plus-minus sign where there is an interval.
std::string interval_text(double value, const std::optional<double>& u95);

/// A measure with its interval and unit: "251.3 ± 0.2 mm", "9.5 ± 0.6°".
std::string measure_text(const Measure& measure);

/// "97 %": whole ones of a share, rounded down, so that only all of it is 100.
std::string at_least_percent(double share);

/// An identifier as words: "ball_girth" becomes "ball girth".
std::string as_words(std::string id);

}  // namespace instep
