#pragma once

#include <optional>
#include <string>

#include "core/result.h"

namespace instep {

/// What a person is told anew when it changes. A device that is looked for again and again is
/// missed in other words than at its loss, "none of 2 chips", and is away all the same.
inline std::optional<ErrorCode> cause_of(const std::optional<Error>& trouble) {
  if (!trouble) return std::nullopt;
  return trouble->code == ErrorCode::kDeviceGone ? ErrorCode::kNotFound : trouble->code;
}

/// What of a trouble of `part` a person is told once for as long as it lasts: that it is away, in
/// whatever words, which tell of what is there instead; of any other trouble, the words.
inline std::string told_once(const std::string& part, const Error& trouble) {
  return cause_of(trouble) == ErrorCode::kNotFound ? part + " is away" : trouble.line();
}

}  // namespace instep
