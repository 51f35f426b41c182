#include "daemon/loop/caught.h"

#include <fmt/format.h>

#include <exception>
#include <new>

namespace instep {

Error error_of_thrown(std::string_view doing) {
  const auto fault = [doing](const char* what) {
    return Error{ErrorCode::kInternal, Remedy::kBug, fmt::format("{} broke off: {}", doing, what),
                 "scan again; if it happens again, report it"};
  };
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return {ErrorCode::kInternal, Remedy::kRetry, "there is not enough memory",
            "close other programs, or lower capture.frames_per_camera"};
  } catch (const std::exception& error) {
    return fault(error.what());
  } catch (...) {
    return fault("nobody knows why");
  }
}

}  // namespace instep
