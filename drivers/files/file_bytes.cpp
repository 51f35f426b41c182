#include "drivers/files/file_bytes.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <system_error>

#include "drivers/files/descriptor.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

Result<void> check_regular(const struct stat& status, const fs::path& path, const char* advice) {
  if (S_ISREG(status.st_mode)) return {};
  const char* kind = S_ISDIR(status.st_mode) ? "a folder" : "no regular file";
  return fail(ErrorCode::kInvalidInput, fmt::format("{} is {}", path.string(), kind), advice);
}

Result<std::size_t> checked_size(int descriptor, const fs::path& path, std::size_t most_bytes) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) {
    return tl::make_unexpected(file_error(errno, "read", path));
  }
  const char* advice =
      S_ISDIR(status.st_mode) ? "give the name of a file" : "save the data in a file first";
  if (auto regular = check_regular(status, path, advice); !regular) {
    return tl::make_unexpected(regular.error());
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > most_bytes) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{} has {} bytes, more than the {} that are read", path.string(), size,
                            most_bytes),
                "thin the data out");
  }
  return size;
}

/// Whose the file that is replaced is, and who may read it.
struct Owned {
  uid_t user;
  gid_t group;
  mode_t mode;
};

/// Nothing where there is none. A device, a pipe or a folder is not replaced.
Result<std::optional<Owned>> replaced_by(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno == ENOENT) return std::nullopt;
    return tl::make_unexpected(file_error(errno, "write", path));
  }
  return check_regular(status, path, "choose another name").map([&] {
    return std::optional(Owned{status.st_uid, status.st_gid, status.st_mode & 0777U});
  });
}

/// A new file beside `path`, which gets its name.
int open_beside(const fs::path& path, mode_t mode, std::string& name) {
  static std::atomic<unsigned> count = 0;
  int file = -1;
  do {
    name = fmt::format("{}.{}-{}", path.string(), ::getpid(), count++);
    file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  } while (file < 0 && errno == EEXIST);
  return file;
}

/// Makes the renaming itself last through a power cut. Some file systems cannot, which is no fault.
void sync_folder(const fs::path& folder) {
  const Descriptor descriptor(
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.is_open()) ::fsync(descriptor.number());
}

/// Whom a file may not be given to, it is not; others may read it no more than before.
bool give_to(int file, const Owned& owned) {
  if (::fchown(file, owned.user, owned.group) != 0 && errno != EPERM) return false;
  return ::fchmod(file, owned.mode) == 0;
}

}  // namespace

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

fs::path end_of_links(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code failed;
  for (int link = 0; link < kMostLinks && fs::is_symlink(path, failed); ++link) {
    path = path.parent_path() / fs::read_symlink(path, failed);
  }
  return path;
}

Error file_error(int error_number, const std::string& doing, const std::filesystem::path& path) {
  if (path.empty()) {
    return fail(ErrorCode::kInvalidInput, "the name of what to " + doing + " is empty",
                "give a name")
        .value();
  }
  ErrorCode code = ErrorCode::kIo;
  std::string advice = "check the disk";
  switch (error_number) {
    case ENOENT:
    case ENOTDIR:
      code = ErrorCode::kNotFound;
      advice = "check the name";
      break;
    case EACCES:
    case EPERM:
      code = ErrorCode::kPermissionDenied;
      advice = "change its permissions or run as a user who may";
      break;
    case EROFS:
      advice = kReadOnlyAdvice;
      break;
    case ENOSPC:
    case EDQUOT:
      code = ErrorCode::kNoSpace;
      advice = "free some disk space";
      break;
    case EINVAL:
    case ENAMETOOLONG:
    case ELOOP:
    case EISDIR:
      code = ErrorCode::kInvalidInput;
      advice = "choose another name";
      break;
    default:
      break;
  }
  const std::string reason = std::generic_category().message(error_number);
  return fail(code, fmt::format("cannot {} {} ({})", doing, path.string(), reason), advice).value();
}

Result<std::string> read_file_bytes(const std::filesystem::path& path, std::size_t most_bytes) {
  // O_NONBLOCK keeps the opening of a pipe that has no writer from waiting.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.is_open()) return tl::make_unexpected(file_error(errno, "read", path));
  const auto size = checked_size(file.number(), path, most_bytes);
  if (!size) return tl::make_unexpected(size.error());

  std::string bytes(*size, '\0');
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t count = ::read(file.number(), bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return tl::make_unexpected(file_error(errno, "read", path));
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  bytes.resize(filled);
  return bytes;
}

Result<void> write_file_bytes(const std::filesystem::path& path, std::string_view bytes,
                              Readers of_new) {
  const auto old = replaced_by(path);
  if (!old) return tl::make_unexpected(old.error());
  const fs::path target = end_of_links(path);
  std::string temporary;
  Descriptor file(open_beside(target, *old ? (*old)->mode : 0666, temporary));
  if (!file.is_open()) return tl::make_unexpected(file_error(errno, "write", path));

  const bool is_for_all = !*old && of_new == Readers::kAll;
  const bool written = (!*old || give_to(file.number(), **old)) &&
                       (!is_for_all || ::fchmod(file.number(), 0644) == 0) &&
                       write_all(file.number(), bytes) && ::fsync(file.number()) == 0 &&
                       file.close() && ::rename(temporary.c_str(), target.c_str()) == 0;
  if (!written) {
    const Error error = file_error(errno, "write", path);
    ::unlink(temporary.c_str());
    return tl::make_unexpected(error);
  }
  sync_folder(target.parent_path());
  return {};
}

}  // namespace instep
