#include "daemon/station/opening_failure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>

namespace instep {

Error OpeningFailure::as_one() const {
  Error all = sources.front().error;
  for (std::size_t i = 1; i < sources.size(); ++i) all.message += "; " + sources[i].error.message;
  if (!without_fault.empty()) {
    all.message += fmt::format(" (no fault so far: {})", fmt::join(without_fault, ", "));
  }
  return all;
}

}  // namespace instep
