#pragma once

#include <optional>
#include <string_view>

#include "core/result.h"

namespace instep {

/// What to_string() calls so; nothing has any other name.
std::optional<ErrorCode> error_code_from(std::string_view name);
std::optional<Remedy> remedy_from(std::string_view name);

}  // namespace instep
