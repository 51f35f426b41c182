#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>

#include "core/result.h"
#include "drivers/files/descriptor.h"

namespace instep {

/// The asking end of the local protocol (protocol.h). One thread owns it; every call has a limit.
class ControlClient {
 public:
  /// Fails with kNotFound, saying how to start it, if no daemon answers on the socket, and with
  /// kTimeout if one hangs.
  static Result<ControlClient> connect(const std::filesystem::path& socket);

  /// Sends {"verb", "id"} and returns the answer; events that come before it are passed over. An
  /// answer that is an error is returned as that error. Fails like next() too; then connect again,
  /// for half of the request may have been sent, and a late answer would be taken for the next.
  Result<nlohmann::json> ask(const std::string& verb, const std::string& id = {},
                             std::chrono::milliseconds limit = std::chrono::seconds(10));

  /// The next line the daemon sends. Fails with kTimeout if none comes within the limit,
  /// kDeviceGone if the daemon ended, kIo if the system does not let it wait.
  Result<nlohmann::json> next(std::chrono::milliseconds limit);

  /// As whom the daemon runs, as the kernel knows it.
  std::optional<uid_t> daemon_user() const;

 private:
  explicit ControlClient(Descriptor socket) : socket_(std::move(socket)) {}

  Descriptor socket_;
  std::string input_;
};

}  // namespace instep
