#include "daemon/control/unix_socket.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace instep {
namespace {

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

}  // namespace

Result<int> connect_unix_socket(const std::filesystem::path& path) {
  const auto address = address_of(path);
  if (!address) return tl::make_unexpected(address.error());
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return failed("making a socket for", path);
  if (::connect(descriptor, generic(*address), sizeof *address) == 0) return descriptor;
  if (errno == ECONNREFUSED) errno = ENOENT;
  const auto error = failed("reaching", path);
  ::close(descriptor);
  return error;
}

Result<int> listen_on_unix_socket(const std::filesystem::path& path) {
  const auto address = address_of(path);
  if (!address) return tl::make_unexpected(address.error());
  struct stat there {};
  if (::lstat(path.c_str(), &there) == 0) {
    if (!S_ISSOCK(there.st_mode)) {
      return fail(ErrorCode::kInvalidInput, path.string() + " is there and is no socket",
                  "choose another control.socket");
    }
    if (const auto other = connect_unix_socket(path)) {
      ::close(*other);
      return fail(ErrorCode::kBusy, Remedy::kOperator,
                  "another instepd answers on " + path.string(),
                  "stop it, or give this one its own control.socket");
    }
    ::unlink(path.c_str());
  }
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (descriptor < 0) return failed("making a socket for", path);
  // Where nothing is installed nobody has made it. If it cannot be made, binding says so.
  ::mkdir(path.parent_path().c_str(), 0755);
  // The mode is right from the start: with the umask it never was wider for a moment.
  const mode_t before = ::umask(0117);
  const bool bound = ::bind(descriptor, generic(*address), sizeof *address) == 0;
  ::umask(before);
  if (bound && ::listen(descriptor, 16) == 0) return descriptor;
  const auto error = failed("listening on", path);
  ::close(descriptor);
  return error;
}

}  // namespace instep
