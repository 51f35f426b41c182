#include "daemon/control/unix_socket.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

namespace instep {
namespace {

/// For learning whether somebody listens.
constexpr std::chrono::seconds kLookWhether(1);

Result<sockaddr_un> address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& name = path.native();
  if (name.empty() || name.size() >= sizeof address.sun_path) {
    return fail(ErrorCode::kInvalidInput, "\"" + name + "\" is no name for a socket",
                "choose a shorter control.socket");
  }
  std::memcpy(address.sun_path, name.c_str(), name.size());
  return address;
}

const sockaddr* generic(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

tl::unexpected<Error> failed(const std::string& doing, const std::filesystem::path& path) {
  const auto code = errno == EACCES || errno == EPERM ? ErrorCode::kPermissionDenied
                    : errno == ENOENT                 ? ErrorCode::kNotFound
                                                      : ErrorCode::kIo;
  return fail(
      code, doing + " " + path.string() + " failed: " + std::strerror(errno),
      "check control.socket (INSTEP_SOCKET names another place) and who may use its folder");
}

tl::unexpected<Error> no_socket(const std::filesystem::path& path) {
  return fail(ErrorCode::kInvalidInput, path.string() + " is there and is no socket",
              "choose another control.socket (INSTEP_SOCKET names another place)");
}

bool listens_without_file(const std::filesystem::path& path) {
  if (FileIdentity::of(path)) return false;
  // Num RefCount Protocol Flags Type St Inode Path
  std::ifstream sockets("/proc/net/unix");
  for (std::string line; std::getline(sockets, line);) {
    std::istringstream fields(line);
    std::string skipped;
    std::string flags;
    std::string name;
    for (int i = 0; i < 3; ++i) fields >> skipped;
    fields >> flags;
    for (int i = 0; i < 3; ++i) fields >> skipped;
    std::getline(fields >> std::ws, name);
    constexpr const char* kListens = "00010000";
    if (flags == kListens && name == path) return true;
  }
  return false;
}

tl::unexpected<Error> taken(const std::filesystem::path& path) {
  if (has_lost_listener(path)) {
    return fail(ErrorCode::kBusy, Remedy::kOperator,
                "another instepd runs whose socket " + path.string() + " was removed",
                "start that one again: sudo systemctl restart instepd");
  }
  return fail(ErrorCode::kBusy, Remedy::kOperator,
              "another instepd answers on " + path.string() + ", or is about to",
              "stop it, or give this one its own control.socket");
}

}  // namespace

Result<Descriptor> connect_unix_socket(const std::filesystem::path& path,
                                       std::chrono::microseconds limit) {
  const auto address = address_of(path);
  if (!address) return tl::make_unexpected(address.error());
  Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!socket.is_open()) return failed("making a socket for", path);
  // Where more wait than a listener takes, as before a daemon that hangs, connecting waits too.
  const timeval longest{limit.count() / 1000000, limit.count() % 1000000};
  ::setsockopt(socket.number(), SOL_SOCKET, SO_SNDTIMEO, &longest, sizeof longest);
  if (::connect(socket.number(), generic(*address), sizeof *address) == 0) return socket;
  const int reason = errno;
  if (reason == EAGAIN) {
    return fail(ErrorCode::kTimeout, "what listens on " + path.string() + " takes no connection",
                kIfItHangs);
  }
  struct stat there {};
  if (::stat(path.c_str(), &there) == 0 && !S_ISSOCK(there.st_mode)) return no_socket(path);
  errno = reason == ECONNREFUSED ? ENOENT : reason;
  return failed("reaching", path);
}

bool has_lost_listener(const std::filesystem::path& path) {
  // One that ends removes the file and closes the socket a moment later.
  constexpr std::chrono::milliseconds kMoment{50};
  if (!listens_without_file(path)) return false;
  std::this_thread::sleep_for(kMoment);
  return listens_without_file(path);
}

Result<ListeningSocket> ListeningSocket::open(const std::filesystem::path& path) {
  // Where nothing is installed nobody has made it. If it cannot be made, locking says so.
  ::mkdir(path.parent_path().c_str(), 0755);
  ListeningSocket socket(path);
  const auto opened = socket.lock().and_then([&] { return socket.make_way(); }).and_then([&] {
    return socket.listen();
  });
  if (!opened) return tl::make_unexpected(opened.error());
  return socket;
}

ListeningSocket::ListeningSocket(ListeningSocket&&) noexcept = default;

ListeningSocket::~ListeningSocket() {
  if (!lock_.is_open()) return;
  remove_if_same(path_, socket_);
  // While it is locked, so that nobody is robbed of one just locked.
  remove_if_same(lock_path(), FileIdentity::of(lock_.number()));
}

Result<void> ListeningSocket::lock() {
  // Reading is enough to lock it, and anyone's left-over can be read.
  constexpr mode_t kReadable = 0644;
  const std::string name = lock_path();
  while (true) {
    Descriptor file(
        ::open(name.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, kReadable));
    if (!file.is_open()) return failed("locking", name);
    if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0) {
      if (errno == EINTR) continue;
      return errno == EWOULDBLOCK ? taken(path_) : failed("locking", name);
    }
    // The one that had it may have removed it in between.
    if (FileIdentity::of(name) != FileIdentity::of(file.number())) continue;
    ::fchmod(file.number(), kReadable);
    lock_ = std::move(file);
    return {};
  }
}

Result<void> ListeningSocket::make_way() const {
  struct stat there {};
  if (::lstat(path_.c_str(), &there) != 0) return {};
  if (!S_ISSOCK(there.st_mode)) return no_socket(path_);
  const auto other = connect_unix_socket(path_, kLookWhether);
  if (other || other.error().code == ErrorCode::kTimeout) return taken(path_);
  ::unlink(path_.c_str());
  return {};
}

Result<void> ListeningSocket::listen() {
  const auto address = address_of(path_);
  if (!address) return tl::make_unexpected(address.error());
  descriptor_ = Descriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!descriptor_.is_open()) return failed("making a socket for", path_);
  // The mode is right from the start: with the umask it never was wider for a moment.
  const mode_t before = ::umask(0117);
  const bool bound = ::bind(descriptor(), generic(*address), sizeof *address) == 0;
  ::umask(before);
  if (!bound) return failed("listening on", path_);
  socket_ = FileIdentity::of(path_);
  if (::listen(descriptor(), 16) != 0) return failed("listening on", path_);
  return {};
}

}  // namespace instep
