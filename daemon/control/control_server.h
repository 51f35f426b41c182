#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/result.h"
#include "daemon/control/protocol.h"
#include "daemon/control/unix_socket.h"
#include "daemon/loop/event_loop.h"
#include "drivers/files/descriptor.h"

namespace instep {

/// The listening end of the local protocol (protocol.h), on the event loop; never blocks. Clients
/// cannot hurt it: their number, the length of their lines and the unread output they may pile up
/// are bounded, and who goes beyond is disconnected. Of each client one request is open at a time,
/// until its answer has been taken, so that answers come in order and do not pile up; those behind
/// it wait, the most of them unread in its socket.
class ControlServer {
 public:
  using Client = std::uint64_t;
  /// When another comes, the one that was quiet for longest and waits for nothing has to go.
  static constexpr std::size_t kMostClients = 32;
  /// So that a request finds a place beside those who only watch.
  static constexpr std::size_t kMostWatchers = 24;
  static constexpr std::size_t kMostUnreadBytes = 20 * 1024 * 1024;

  /// A sound request; answer() it once, now or later.
  using Handler = std::function<void(Client, const Request&)>;

  /// Takes over a stale socket. Fails with kBusy if another daemon answers on it, and with
  /// kPermissionDenied, kNotFound or kIo if it cannot be made.
  static Result<std::unique_ptr<ControlServer>> listen(EventLoop& loop,
                                                       const std::filesystem::path& socket,
                                                       Handler handler);
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  /// Lines without their end. A client that has gone is passed over.
  void answer(Client client, const std::string& line);
  /// From now on the client gets every event. Fails with kBusy if too many do.
  Result<void> add_watcher(Client client);
  void send_event(Client client, const std::string& line);
  void broadcast(const std::string& line);
  bool has_watchers() const;

 private:
  struct Connection {
    Descriptor socket;
    EventLoop::Watch watch;  ///< of the socket, which it does not outlive
    std::string input;
    std::string output;
    bool has_open_request = false;
    bool takes_lines = false;  ///< answers given meanwhile leave the next line to take_lines()
    bool is_read_out = false;  ///< it has shut down its writing side
    bool watches = false;
    std::uint64_t last_heard = 0;  ///< grows with each word of any client

    /// It asked its last, and was told all that it asked.
    bool is_done() const;
    void await_events();
  };

  ControlServer(EventLoop& loop, std::filesystem::path path, Handler handler)
      : loop_(loop), path_(std::move(path)), handler_(std::move(handler)) {}
  Result<void> open();
  void accept();
  void take_up(std::shared_ptr<Connection> connection);
  /// False if each connection is needed.
  bool make_place();
  void ready(Client client, std::uint32_t events);
  /// False if the client has to go.
  bool read(Connection& connection);
  bool take_lines(Client client, Connection& connection);
  void send(Client client, const std::string& line);
  bool flush(Connection& connection);
  void drop(Client client);

  EventLoop& loop_;
  std::filesystem::path path_;
  Handler handler_;
  std::optional<ListeningSocket> socket_;
  EventLoop::Watch watch_;
  EventLoop::Timer listen_again_;
  std::uint64_t heard_ = 0;
  Client next_client_ = 1;
  std::map<Client, std::shared_ptr<Connection>> connections_;
};

}  // namespace instep
