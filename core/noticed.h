#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace instep {

/// A failure whose cause may be what was warned of on the way to it: its advice tells that too.
/// What was cancelled comes back as it is.
inline Error with_what_was_noticed(Error error, const std::vector<std::string>& warnings) {
  if (error.code == ErrorCode::kCancelled) return error;
  const std::string lead = "; what was noticed before: ";
  for (const auto& warning : warnings) {
    const bool is_led = error.advice.find(lead) != std::string::npos;
    error.advice += (is_led ? "; " : lead) + warning;
  }
  return error;
}

}  // namespace instep
