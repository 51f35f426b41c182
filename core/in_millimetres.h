#pragma once

#include <cstdio>
#include <string>

namespace instep {

/// A length as a message tells it, to a tenth: "1.3 mm".
inline std::string in_millimetres(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f mm", value);
  return text;
}

}  // namespace instep
