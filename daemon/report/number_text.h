#pragma once

#include <optional>
#include <string>

namespace instep {

/// "251.3", or "251.3 +- 0.2" with a true plus-minus sign where there is an interval.
std::string interval_text(double value, const std::optional<double>& u95);

/// An identifier as words: "ball_girth" becomes "ball girth".
std::string as_words(std::string id);

}  // namespace instep
