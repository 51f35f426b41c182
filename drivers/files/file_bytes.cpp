#include "drivers/files/file_bytes.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "drivers/files/descriptor.h"

namespace instep {
namespace {

Result<std::size_t> checked_size(int descriptor, const std::filesystem::path& path,
                                 std::size_t most_bytes) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) {
    return tl::make_unexpected(file_error(errno, "read", path));
  }
  if (S_ISDIR(status.st_mode)) {
    return fail(ErrorCode::kInvalidInput, fmt::format("{} is a folder", path.string()),
                "give the name of a file");
  }
  if (!S_ISREG(status.st_mode)) {
    return fail(ErrorCode::kInvalidInput, fmt::format("{} is no regular file", path.string()),
                "save the data in a file first");
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

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Makes the renaming itself last through a power cut. Some file systems cannot, which is no fault.
void sync_folder(const std::filesystem::path& folder) {
  const Descriptor descriptor(
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.is_open()) ::fsync(descriptor.number());
}

}  // namespace

Error file_error(int error_number, const std::string& doing, const std::filesystem::path& path) {
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

Result<void> write_file_bytes(const std::filesystem::path& path, std::string_view bytes) {
  std::string temporary = path.string() + ".XXXXXX";
  Descriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
  if (!file.is_open()) return tl::make_unexpected(file_error(errno, "write", path));

  const bool written = ::fchmod(file.number(), 0644) == 0 && write_all(file.number(), bytes) &&
                       ::fsync(file.number()) == 0 && file.close() &&
                       ::rename(temporary.c_str(), path.c_str()) == 0;
  if (!written) {
    const Error error = file_error(errno, "write", path);
    ::unlink(temporary.c_str());
    return tl::make_unexpected(error);
  }
  sync_folder(path.parent_path());
  return {};
}

}  // namespace instep
