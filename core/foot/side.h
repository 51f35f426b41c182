#pragma once

#include <optional>
#include <string_view>

namespace instep {

enum class Side { kLeft, kRight };

inline const char* to_string(Side side) {
  return side == Side::kLeft ? "left" : "right";
}

inline std::optional<Side> side_from_string(std::string_view text) {
  if (text == "left") return Side::kLeft;
  if (text == "right") return Side::kRight;
  return std::nullopt;
}

}  // namespace instep
