#pragma once

#include <cstdio>
#include <string>

namespace instep {

/// A share as a message tells it, to a tenth of a percent: "0.4 %".
inline std::string in_percent(double share) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f %%", 100.0 * share);
  return text;
}

}  // namespace instep
