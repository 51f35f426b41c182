#include "daemon/store/posix_storage.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>

#include "daemon/machine/folder_rights.h"
#include "drivers/files/file_bytes.h"
#include "drivers/files/file_identity.h"
#include "drivers/files/system_user.h"

namespace instep {
namespace {

constexpr mode_t kFileMode = 0640;
constexpr mode_t kFolderMode = 0750;

template <typename Call>
auto uninterrupted(Call call) {
  auto outcome = call();
  while (outcome == -1 && errno == EINTR) outcome = call();
  return outcome;
}

Descriptor open_to_read(const std::filesystem::path& path, int flags) {
  return Descriptor(
      uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags); }));
}

/// With what lies in a folder.
tl::unexpected<Error> failed(const std::string& doing, const std::filesystem::path& path) {
  return tl::make_unexpected(storage_error(errno, doing, path, path.parent_path()));
}

tl::unexpected<Error> folder_failed(const std::string& doing, const std::filesystem::path& path) {
  return tl::make_unexpected(storage_error(errno, doing, path, path));
}

/// If not, errno tells why.
bool is_locked(const Descriptor& folder, int how) {
  return uninterrupted([&] { return ::flock(folder.number(), how | LOCK_NB); }) == 0;
}

/// What it may not look into hides whether the folder is there, which may well not be.
std::string advice_on_rights(const std::filesystem::path& folder) {
  const std::string user = user_name(::geteuid());
  struct stat there {};
  if (::stat(folder.c_str(), &there) == 0 || errno != EACCES) {
    return "it runs as the user " + user + ": " + advice_to_give(folder, ::geteuid());
  }
  auto seen = folder;
  while (seen.has_relative_path() && ::stat(seen.c_str(), &there) != 0) seen = seen.parent_path();
  return "it runs as the user " + user + ", who may not look into " + seen.string() +
         ": choose another store.root (INSTEP_STORE names another place), or let it in";
}

bool leads_to_folder(const std::filesystem::path& path) {
  struct stat there {};
  return ::stat(path.c_str(), &there) == 0 && S_ISDIR(there.st_mode);
}

}  // namespace

Error storage_error(int error_number, const std::string& doing, const std::filesystem::path& path,
                    const std::filesystem::path& folder) {
  Error error = file_error(error_number, doing, path);
  if (error_number == EROFS) {
    // To a service of systemd all is read-only but what its unit names.
    error.advice += "; or name it in ReadWritePaths= (systemctl edit instepd)";
    return error;
  }
  switch (error.code) {
    case ErrorCode::kNoSpace:
      error.advice =
          "make room on the disk of the results, or let store.keep_days do it; then scan again";
      break;
    case ErrorCode::kPermissionDenied:
      error.advice = advice_on_rights(folder);
      break;
    case ErrorCode::kNotFound:
      error.advice =
          "check store.root (INSTEP_STORE names another place): all but its last folder has to be "
          "there";
      break;
    default:
      error.advice = "check the disk of the results";
      break;
  }
  return error;
}

Result<Storage::File> PosixStorage::create_file(const std::filesystem::path& path) {
  const int flags = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW;
  const int file = uninterrupted([&] { return ::open(path.c_str(), flags, kFileMode); });
  if (file < 0) return failed("make", path);
  // What the umask took away of the group's right to read is given back.
  if (::fchmod(file, kFileMode) != 0) {
    const auto error = failed("give rights to", path);
    ::close(file);
    return error;
  }
  return file;
}

Result<std::size_t> PosixStorage::write(File file, std::string_view bytes) {
  const auto written = uninterrupted([&] { return ::write(file, bytes.data(), bytes.size()); });
  if (written < 0) return failed("write", "a result");
  return static_cast<std::size_t>(written);
}

Result<void> PosixStorage::sync(File file) {
  if (uninterrupted([&] { return ::fsync(file); }) != 0) return failed("flush", "a result");
  return {};
}

void PosixStorage::close(File file) {
  ::close(file);
}

Result<void> PosixStorage::make_folder(const std::filesystem::path& path) {
  if (::mkdir(path.c_str(), kFolderMode) == 0) {
    if (::chmod(path.c_str(), kFolderMode) != 0) return failed("give rights to", path);
    return {};
  }
  if (errno != EEXIST) return failed("make", path);
  if (leads_to_folder(path)) return {};
  return fail(ErrorCode::kNotFound, Remedy::kOperator,
              path.string() + " is there and is no folder, or a link to one that is not there",
              "mount the disk that it leads to, or put it away");
}

Result<void> PosixStorage::rename(const std::filesystem::path& from,
                                  const std::filesystem::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) return failed("rename", from);
  return {};
}

Result<void> PosixStorage::remove_file(const std::filesystem::path& path) {
  if (::unlink(path.c_str()) != 0) return failed("delete", path);
  return {};
}

Result<void> PosixStorage::remove_folder(const std::filesystem::path& path) {
  if (::rmdir(path.c_str()) != 0) return failed("delete", path);
  return {};
}

Result<void> PosixStorage::sync_folder(const std::filesystem::path& path) {
  const Descriptor folder = open_to_read(path, O_DIRECTORY);
  if (!folder.is_open()) return folder_failed("open", path);
  if (uninterrupted([&] { return ::fsync(folder.number()); }) != 0)
    return folder_failed("flush", path);
  return {};
}

Result<void> PosixStorage::check_writing(const std::filesystem::path& path) {
  if (::access(path.c_str(), W_OK | X_OK) != 0) return folder_failed("write in", path);
  return {};
}

Result<bool> PosixStorage::take_hold(const std::filesystem::path& path) {
  const std::lock_guard lock(mutex_);
  held_ = Descriptor();  // else what it locked itself would look like another's
  held_ = open_to_read(path, O_DIRECTORY);
  has_lock_ = false;
  if (!held_.is_open()) return folder_failed("open", path);
  was_held_ = true;
  // Where the file system knows no locks, nothing tells of others.
  const bool is_alone = is_locked(held_, LOCK_EX) || errno != EWOULDBLOCK;
  has_lock_ = is_alone || is_locked(held_, LOCK_SH);
  return is_alone;
}

void PosixStorage::share_hold() {
  const std::lock_guard lock(mutex_);
  if (held_.is_open()) has_lock_ = is_locked(held_, LOCK_SH);
}

Result<void> PosixStorage::keep_hold(const std::filesystem::path& path) {
  const std::lock_guard lock(mutex_);
  if (!was_held_) return {};
  const Descriptor there = open_to_read(path, O_PATH | O_DIRECTORY);
  const bool is_gone = !there.is_open() && (errno == ENOENT || errno == ENOTDIR);
  if (!there.is_open() && !is_gone) return folder_failed("open", path);
  if (is_gone || !held_.is_open() ||
      FileIdentity::of(there.number()) != FileIdentity::of(held_.number())) {
    held_ = Descriptor();  // a disk that is held cannot be let go of, nor mounted anew by some
    const std::string advice =
        "mount its disk again; or if results are to be kept in a new one from now on, start it "
        "again: sudo systemctl restart instepd";
    return is_gone
               ? fail(ErrorCode::kNotFound, "the results' folder " + path.string() + " is gone",
                      advice)
               : fail(ErrorCode::kDeviceGone, Remedy::kOperator,
                      path.string() + " is another folder than the one the results were kept in",
                      advice);
  }
  if (has_lock_ || is_locked(held_, LOCK_SH) || errno != EWOULDBLOCK) {
    has_lock_ = true;
    return {};
  }
  return fail(ErrorCode::kBusy, "another program clears the results' folder " + path.string(),
              "wait until it has; and give each daemon its own store.root");
}

Result<std::vector<Storage::Entry>> PosixStorage::list(const std::filesystem::path& path) {
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(::opendir(path.c_str()), &::closedir);
  if (!folder) return folder_failed("list", path);
  std::vector<Entry> entries;
  errno = 0;
  while (const dirent* entry = ::readdir(folder.get())) {
    const std::string name = entry->d_name;
    if (name == "." || name == "..") continue;
    bool is_folder = entry->d_type == DT_DIR;
    bool is_link = entry->d_type == DT_LNK;
    if (entry->d_type == DT_UNKNOWN) {
      struct stat there {};
      const bool is_known = ::lstat((path / name).c_str(), &there) == 0;
      is_folder = is_known && S_ISDIR(there.st_mode);
      is_link = is_known && S_ISLNK(there.st_mode);
    }
    entries.push_back({name, is_folder, is_link && leads_to_folder(path / name)});
    errno = 0;
  }
  if (errno != 0) return folder_failed("list", path);
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.name < b.name; });
  return entries;
}

Result<std::string> PosixStorage::read(const std::filesystem::path& path, std::size_t most) {
  // A pipe would let its reader wait for ever.
  const Descriptor file = open_to_read(path, O_NOFOLLOW | O_NONBLOCK);
  if (!file.is_open()) return failed("read", path);
  struct stat there {};
  if (::fstat(file.number(), &there) != 0) return failed("read", path);
  if (!S_ISREG(there.st_mode)) {
    return fail(ErrorCode::kCorruptData, path.string() + " is no plain file", "delete that result");
  }
  std::string content;
  std::string block(1 << 16, '\0');
  while (true) {
    const auto got =
        uninterrupted([&] { return ::read(file.number(), block.data(), block.size()); });
    if (got < 0) return failed("read", path);
    if (got == 0) return content;
    content.append(block, 0, static_cast<std::size_t>(got));
    if (content.size() > most) {
      return fail(ErrorCode::kCorruptData, path.string() + " is larger than any result",
                  "delete that result");
    }
  }
}

}  // namespace instep
