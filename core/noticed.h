#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace instep {

/// A failure whose cause may be what was warned of on the way to it: its advice tells that too.
/// What was cancelled comes back as it is.
inline Error with_what_was_noticed(Error error, const std::vector<std::string>& warnings) {
  if (error.code == ErrorCode::kCancelled) return error;
  for (std::size_t i = 0; i < warnings.size(); ++i) {
    error.advice += (i == 0 ? "; what was noticed before: " : "; ") + warnings[i];
  }
  return error;
}

}  // namespace instep
