#pragma once

#include <sys/socket.h>
#include <sys/time.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "daemon/control/unix_socket.h"

namespace instep::test {

/// A client of the local protocol that sends and reads what it likes. Gives up after 30 s.
class LineClient {
 public:
  explicit LineClient(const std::filesystem::path& socket)
      : socket_(connect_unix_socket(socket).value()) {
    const timeval limit{30, 0};
    ::setsockopt(socket_.number(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    ::setsockopt(socket_.number(), SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
  }

  /// False if the daemon has gone.
  bool send(const std::string& bytes) const {
    return ::send(socket_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  void shut_down_writing() const { ::shutdown(socket_.number(), SHUT_WR); }

  /// The next line without its end; nothing once the daemon has ended the connection.
  std::optional<std::string> line() {
    while (true) {
      if (const auto end = input_.find('\n'); end != std::string::npos) {
        std::string found = input_.substr(0, end);
        input_.erase(0, end + 1);
        return found;
      }
      std::array<char, 65536> block;
      const auto got = ::recv(socket_.number(), block.data(), block.size(), 0);
      if (got <= 0) return std::nullopt;
      input_.append(block.data(), static_cast<std::size_t>(got));
    }
  }

 private:
  Descriptor socket_;
  std::string input_;
};

}  // namespace instep::test
