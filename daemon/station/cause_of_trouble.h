#pragma once

#include <optional>

#include "core/result.h"

namespace instep {

/// What a person is told anew when it changes. A device that is looked for again and again is
/// missed in other words than at its loss, "none of 2 chips", and is away all the same.
inline std::optional<ErrorCode> cause_of(const std::optional<Error>& trouble) {
  if (!trouble) return std::nullopt;
  return trouble->code == ErrorCode::kDeviceGone ? ErrorCode::kNotFound : trouble->code;
}

}  // namespace instep
