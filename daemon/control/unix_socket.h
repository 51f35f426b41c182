#pragma once

#include <filesystem>

#include "core/result.h"

namespace instep {

/// A Unix stream socket connected to `path`, close-on-exec; the caller closes it. Fails with
/// kNotFound if nobody listens there, kPermissionDenied, or kIo.
Result<int> connect_unix_socket(const std::filesystem::path& path);

/// One that listens there, non-blocking, mode 0660. A socket that nobody listens on any more is
/// replaced; fails with kBusy if somebody does.
Result<int> listen_on_unix_socket(const std::filesystem::path& path);

}  // namespace instep
