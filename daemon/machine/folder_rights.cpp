#include "daemon/machine/folder_rights.h"

#include <grp.h>
#include <sys/stat.h>
#include <sys/xattr.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "drivers/files/system_user.h"

namespace instep {
namespace {

bool is_in_group(uid_t number, gid_t group) {
  const auto user = find_user(number);
  if (!user) return false;
  std::vector<gid_t> groups(1024);
  int count = static_cast<int>(groups.size());
  if (::getgrouplist(user->name.c_str(), user->group, groups.data(), &count) < 0) return true;
  groups.resize(static_cast<std::size_t>(count));
  return std::find(groups.begin(), groups.end(), group) != groups.end();
}

}  // namespace

bool may_write_in(const std::filesystem::path& folder, uid_t user) {
  struct stat there {};
  if (user == 0 || ::stat(folder.c_str(), &there) != 0) return true;
  if (::getxattr(folder.c_str(), "system.posix_acl_access", nullptr, 0) > 0) return true;
  mode_t needed = S_IWOTH | S_IXOTH;
  if (there.st_uid == user) {
    needed = S_IWUSR | S_IXUSR;
  } else if (is_in_group(user, there.st_gid)) {
    needed = S_IWGRP | S_IXGRP;
  }
  return (there.st_mode & needed) == needed;
}

std::string advice_to_give(const std::filesystem::path& folder, uid_t user) {
  struct stat there {};
  const bool is_theirs = ::stat(folder.c_str(), &there) == 0 && there.st_uid == user;
  return (is_theirs ? "sudo chmod u+rwx " : "sudo chown " + user_name(user) + " ") +
         folder.string();
}

}  // namespace instep
