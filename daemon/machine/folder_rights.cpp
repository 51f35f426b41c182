#include "daemon/machine/folder_rights.h"

#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <sys/xattr.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace instep {
namespace {

struct User {
  std::string name;
  gid_t group = 0;
};

std::optional<User> find_user(uid_t number) {
  std::array<char, 16384> text{};
  passwd entry{};
  passwd* found = nullptr;
  if (::getpwuid_r(number, &entry, text.data(), text.size(), &found) != 0 || found == nullptr) {
    return std::nullopt;
  }
  return User{found->pw_name, found->pw_gid};
}

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

std::string user_name(uid_t user) {
  const auto found = find_user(user);
  return found ? found->name : std::to_string(user);
}

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
