#include "daemon/control/control_server.h"

#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>
#include <vector>

namespace instep {
namespace {

/// As often as that it is tried whether there are descriptors or memory for a client again.
constexpr std::chrono::milliseconds kPauseOfListening{100};

bool is_exhausted(int error) {
  return error == EMFILE || error == ENFILE || error == ENOBUFS || error == ENOMEM;
}

Error too_many() {
  return {ErrorCode::kBusy, Remedy::kRetry, "too many programs talk to the daemon",
          "close some and try again"};
}

/// Tells a client that has no place, as far as it can be told without waiting.
void turn_away(const Descriptor& client, const Error& reason) {
  const std::string line = error_answer(reason) + "\n";
  [[maybe_unused]] const auto sent =
      ::send(client.number(), line.data(), line.size(), MSG_NOSIGNAL);
}

}  // namespace

bool ControlServer::Connection::is_done() const {
  return is_read_out && !has_open_request && !watches && output.empty();
}

void ControlServer::Connection::await_events() {
  std::uint32_t events = 0;
  if (!has_open_request && !is_read_out && output.empty()) events |= EPOLLIN;
  if (!output.empty()) events |= EPOLLOUT;
  watch.set_events(events);
}

Result<std::unique_ptr<ControlServer>> ControlServer::listen(EventLoop& loop,
                                                             const std::filesystem::path& socket,
                                                             Handler handler) {
  std::unique_ptr<ControlServer> server(new ControlServer(loop, socket, std::move(handler)));
  if (const auto opened = server->open(); !opened) return tl::make_unexpected(opened.error());
  return server;
}

Result<void> ControlServer::open() {
  auto socket = ListeningSocket::open(path_);
  if (!socket) return tl::make_unexpected(socket.error());
  socket_.emplace(std::move(*socket));
  auto watching = loop_.watch(socket_->descriptor(), EPOLLIN, [this](std::uint32_t) { accept(); });
  if (!watching) return tl::make_unexpected(watching.error());
  watch_ = std::move(*watching);
  listen_again_ = loop_.timer([this] { watch_.set_events(EPOLLIN); });
  return {};
}

ControlServer::~ControlServer() {
  connections_.clear();
  // Before the socket that it watches.
  watch_ = {};
}

void ControlServer::accept() {
  Descriptor accepted(
      ::accept4(socket_->descriptor(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!accepted.is_open() && is_exhausted(errno)) {
    // Who waits to be let in keeps waking the loop, which could not let them in at once.
    watch_.set_events(0);
    listen_again_.set(kPauseOfListening);
  }
  if (!accepted.is_open()) return;
  auto connection = std::make_shared<Connection>();
  connection->socket = std::move(accepted);
  const bool has_place = connections_.size() < kMostClients || make_place();
  if (!has_place) return turn_away(connection->socket, too_many());
  take_up(std::move(connection));
}

void ControlServer::take_up(std::shared_ptr<Connection> connection) {
  const Client client = next_client_++;
  connection->last_heard = ++heard_;
  auto watching = loop_.watch(connection->socket.number(), EPOLLIN,
                              [this, client](std::uint32_t events) { ready(client, events); });
  if (!watching) return turn_away(connection->socket, watching.error());
  connection->watch = std::move(*watching);
  connections_.emplace(client, std::move(connection));
}

bool ControlServer::make_place() {
  // One that is slow to read its answer goes after those that have read theirs.
  const auto rank = [](const Connection& connection) {
    return std::pair(!connection.output.empty(), connection.last_heard);
  };
  auto quietest = connections_.end();
  for (auto one = connections_.begin(); one != connections_.end(); ++one) {
    if (one->second->watches || one->second->has_open_request) continue;
    if (quietest == connections_.end() || rank(*one->second) < rank(*quietest->second)) {
      quietest = one;
    }
  }
  if (quietest == connections_.end()) return false;
  turn_away(quietest->second->socket, too_many());
  connections_.erase(quietest);
  return true;
}

void ControlServer::ready(Client client, std::uint32_t events) {
  const auto found = connections_.find(client);
  if (found == connections_.end()) return;
  const auto connection = found->second;
  // Nobody is left to read an answer that is still to come.
  const bool left = (events & (EPOLLHUP | EPOLLERR)) != 0 &&
                    (connection->has_open_request || connection->is_read_out);
  const bool stays = !left && ((events & EPOLLOUT) == 0 || flush(*connection)) &&
                     ((events & EPOLLIN) == 0 || read(*connection)) &&
                     take_lines(client, *connection);
  if (!stays) drop(client);
}

bool ControlServer::read(Connection& connection) {
  std::array<char, kLongestRequest> block;
  const auto got = ::recv(connection.socket.number(), block.data(), block.size(), 0);
  if (got < 0) return errno == EAGAIN || errno == EINTR;
  connection.last_heard = ++heard_;
  connection.is_read_out = got == 0;
  connection.input.append(block.data(), static_cast<std::size_t>(got));
  return true;
}

bool ControlServer::take_lines(Client client, Connection& connection) {
  connection.takes_lines = true;
  while (!connection.has_open_request && connection.output.empty()) {
    const auto end = connection.input.find('\n');
    if (std::min(end, connection.input.size()) > kLongestRequest) {
      send(client, error_answer({ErrorCode::kInvalidInput, Remedy::kOperator,
                                 "the request is too long", "send short lines"}));
      return false;
    }
    if (end == std::string::npos) break;
    const std::string line = connection.input.substr(0, end);
    connection.input.erase(0, end + 1);
    connection.has_open_request = true;
    if (const auto request = parse_request(line)) {
      handler_(client, *request);
    } else {
      answer(client, error_answer(request.error()));
    }
    if (!connections_.contains(client)) return false;
  }
  connection.takes_lines = false;
  connection.await_events();
  return !connection.is_done();
}

void ControlServer::answer(Client client, const std::string& line) {
  const auto found = connections_.find(client);
  if (found == connections_.end()) return;
  const auto connection = found->second;
  connection->has_open_request = false;
  send(client, line);
  if (connection->takes_lines || !connections_.contains(client)) return;
  if (!take_lines(client, *connection)) drop(client);
}

void ControlServer::send(Client client, const std::string& line) {
  const auto found = connections_.find(client);
  if (found == connections_.end()) return;
  auto& connection = *found->second;
  connection.output += line;
  connection.output += '\n';
  if (!flush(connection) || connection.output.size() > kMostUnreadBytes) drop(client);
}

bool ControlServer::flush(Connection& connection) {
  std::size_t done = 0;
  while (done < connection.output.size()) {
    const auto sent = ::send(connection.socket.number(), connection.output.data() + done,
                             connection.output.size() - done, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0 && errno != EAGAIN) return false;
    if (sent < 0) break;
    done += static_cast<std::size_t>(sent);
  }
  connection.output.erase(0, done);
  connection.await_events();
  return true;
}

Result<void> ControlServer::add_watcher(Client client) {
  const auto found = connections_.find(client);
  if (found == connections_.end() || found->second->watches) return {};
  const auto watchers = std::count_if(connections_.begin(), connections_.end(),
                                      [](const auto& one) { return one.second->watches; });
  if (static_cast<std::size_t>(watchers) >= kMostWatchers) {
    return fail(ErrorCode::kBusy, "too many programs watch the station",
                "close some and try again");
  }
  found->second->watches = true;
  return {};
}

void ControlServer::send_event(Client client, const std::string& line) {
  send(client, line);
}

void ControlServer::broadcast(const std::string& line) {
  std::vector<Client> watchers;
  for (const auto& [client, connection] : connections_) {
    if (connection->watches) watchers.push_back(client);
  }
  for (const Client client : watchers) send(client, line);
}

bool ControlServer::has_watchers() const {
  return std::any_of(connections_.begin(), connections_.end(),
                     [](const auto& one) { return one.second->watches; });
}

void ControlServer::drop(Client client) {
  connections_.erase(client);
}

}  // namespace instep
