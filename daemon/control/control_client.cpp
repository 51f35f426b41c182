#include "daemon/control/control_client.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "daemon/control/protocol.h"
#include "daemon/control/unix_socket.h"
#include "daemon/json/untrusted_json.h"

namespace instep {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

tl::unexpected<Error> ended() {
  return fail(ErrorCode::kDeviceGone, "the daemon ended the connection",
              "see its log: journalctl -u instepd");
}

/// Until the connection takes or gives bytes.
Result<void> wait_until(steady_clock::time_point deadline, int descriptor, short events) {
  while (true) {
    const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now()).count();
    pollfd waiting{descriptor, events, 0};
    const int ready =
        ::poll(&waiting, 1, static_cast<int>(std::clamp<std::int64_t>(left, 0, 1 << 30)));
    if (ready > 0) return {};
    if (ready == 0) {
      return fail(ErrorCode::kTimeout, "the daemon did not answer in time", kIfItHangs);
    }
    if (errno == EINTR) continue;
    return fail(ErrorCode::kIo,
                std::string("waiting for the daemon failed: ") + std::strerror(errno),
                "check the limits on open files and memory");
  }
}

Result<void> send_all(int descriptor, std::string_view text, steady_clock::time_point deadline) {
  while (!text.empty()) {
    const auto sent = ::send(descriptor, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      text.remove_prefix(static_cast<std::size_t>(sent));
    } else if (errno == EAGAIN) {  // a daemon that hangs does not read
      if (auto ready = wait_until(deadline, descriptor, POLLOUT); !ready) return ready;
    } else if (errno != EINTR) {
      return ended();
    }
  }
  return {};
}

}  // namespace

Result<ControlClient> ControlClient::connect(const std::filesystem::path& socket) {
  auto connected = connect_unix_socket(socket);
  if (connected) return ControlClient(std::move(*connected));
  const bool is_not_found = connected.error().code == ErrorCode::kNotFound;
  if (is_not_found && has_lost_listener(socket)) {
    return fail(ErrorCode::kDeviceGone, Remedy::kOperator,
                "the daemon runs, but its socket " + socket.string() + " was removed",
                "start it again: sudo systemctl restart instepd");
  }
  if (is_not_found) {
    return fail(ErrorCode::kNotFound, "no daemon answers on " + socket.string(),
                "start it with: sudo systemctl start instepd (or run instepd)");
  }
  if (connected.error().code == ErrorCode::kPermissionDenied) {
    return fail(ErrorCode::kPermissionDenied,
                "you may not talk to the daemon on " + socket.string(),
                "join its group: sudo usermod -aG instep $USER, then log in again");
  }
  return tl::make_unexpected(connected.error());
}

std::optional<uid_t> ControlClient::daemon_user() const {
  ucred peer{};
  socklen_t size = sizeof(peer);
  if (::getsockopt(socket_.number(), SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0)
    return std::nullopt;
  return peer.uid;
}

Result<nlohmann::json> ControlClient::ask(const std::string& verb, const std::string& id,
                                          milliseconds limit) {
  const auto deadline = steady_clock::now() + limit;
  nlohmann::json request = {{"verb", verb}};
  if (!id.empty()) request["id"] = id;
  const std::string line =
      request.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  if (const auto sent = send_all(socket_.number(), line, deadline); !sent) {
    return tl::make_unexpected(sent.error());
  }
  while (true) {
    auto answer = next(std::chrono::ceil<milliseconds>(deadline - steady_clock::now()));
    if (!answer) return answer;
    if (answer->contains("event")) continue;
    if (const auto outcome = answer_outcome(*answer); !outcome) {
      return tl::make_unexpected(outcome.error());
    }
    return answer;
  }
}

Result<nlohmann::json> ControlClient::next(milliseconds limit) {
  const auto deadline = steady_clock::now() + limit;
  std::size_t looked_at = 0;
  while (true) {
    const auto end = input_.find('\n', looked_at);
    if (end != std::string::npos) {
      auto line = object_in(std::string_view(input_).substr(0, end));
      input_.erase(0, end + 1);
      if (line.is_object()) return line;
      return tl::make_unexpected(answer_not_understood());
    }
    looked_at = input_.size();
    if (const auto ready = wait_until(deadline, socket_.number(), POLLIN); !ready) {
      return tl::make_unexpected(ready.error());
    }
    std::array<char, 65536> block;
    const auto got = ::recv(socket_.number(), block.data(), block.size(), 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return ended();
    input_.append(block.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace instep
