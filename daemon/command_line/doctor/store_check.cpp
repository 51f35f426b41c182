#include "daemon/command_line/doctor/store_check.h"

#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "daemon/command_line/doctor/closed_check.h"
#include "daemon/machine/folder_rights.h"
#include "drivers/files/file_bytes.h"
#include "drivers/files/system_user.h"

namespace instep {
namespace {

/// For no daemon runs: may it, or whoever runs it, write there?
bool may_owner_write(const std::filesystem::path& folder) {
  struct stat there {};
  if (::stat(folder.c_str(), &there) != 0) return false;
  const auto user = installed_user();
  const bool is_daemons = user ? there.st_uid == *user : there.st_uid != 0;
  return is_daemons && (there.st_mode & S_IWUSR) != 0 && (there.st_mode & S_IXUSR) != 0;
}

/// Whoever asks needs no right to write: it is the daemon that keeps the results.
DoctorCheck check_writing(const std::filesystem::path& folder, std::optional<uid_t> daemon) {
  struct statvfs disk {};
  if (::statvfs(folder.c_str(), &disk) == 0 && (disk.f_flag & ST_RDONLY) != 0) {
    return bad_check("store", folder.string() + " is read-only", kReadOnlyAdvice);
  }
  if (daemon) {
    if (may_write_in(folder, *daemon)) {
      return good_check("store", folder.string() + ", kept by the daemon");
    }
    return bad_check(
        "store",
        "the daemon, of the user " + user_name(*daemon) + ", may not write in " + folder.string(),
        advice_to_give(folder, *daemon));
  }
  if (::access(folder.c_str(), W_OK | X_OK) == 0) {
    return good_check("store", folder.string() + ", writable");
  }
  const std::string trouble = std::strerror(errno);
  if (may_owner_write(folder))
    return good_check("store", folder.string() + ", writable for its owner");
  const auto user = installed_user();
  return bad_check("store", "the daemon may not write in " + folder.string() + ": " + trouble,
                   user ? advice_to_give(folder, *user) : "set store.root to a folder of your own");
}

}  // namespace

DoctorCheck check_store(const std::filesystem::path& root, std::optional<uid_t> daemon) {
  std::error_code failed;
  const bool there = std::filesystem::exists(root, failed);
  const auto folder = there ? root : root.parent_path();
  if (there && !std::filesystem::is_directory(root, failed)) {
    return bad_check("store", root.string() + " is no folder", "set store.root to a folder");
  }
  if (!std::filesystem::is_directory(folder, failed)) {
    return bad_check("store", folder.string() + " is not there",
                     installed_user()
                         ? "sudo install -d -o instep -g instep -m 0750 " + folder.string()
                         : "install Instep (README.md), or set store.root to a folder of your own");
  }
  auto check = check_writing(folder, daemon);
  if (check.good && !there) check.finding = "will be made in " + check.finding;
  return check;
}

}  // namespace instep
