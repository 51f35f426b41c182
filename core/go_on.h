#pragma once

#include <functional>

#include "core/result.h"

namespace instep {

/// How long work tells that it lives and hears whether it is still wanted. It calls this each time
/// a piece of it is done, some milliseconds to some hundred of them, and never otherwise; so who
/// counts the calls can tell a long work from a hung one. After the first false it does nothing
/// more than the pieces that are begun, and fails with kCancelled.
///
/// Called from the threads that do the work, at times from several at once; it must not throw.
using GoOn = std::function<bool()>;

/// For work that nobody watches.
inline bool always() {
  return true;
}

/// What work fails with that is no longer wanted.
inline tl::unexpected<Error> cancelled() {
  return fail(ErrorCode::kCancelled, "the scan was cancelled", "scan again when you are ready");
}

}  // namespace instep
