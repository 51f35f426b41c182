#include "core/girth/girth.h"

namespace instep {

Result<void> check_options(const GirthOptions& options) {
  if (options.sigma_mm && !(*options.sigma_mm > 0.0 && *options.sigma_mm <= kLargestSigmaMm)) {
    return fail(ErrorCode::kInvalidInput,
                "the noise that was given is not above 0, or above 100 mm",
                "give the standard deviation of a point in millimetres, or none");
  }
  return {};
}

}  // namespace instep
