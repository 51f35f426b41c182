#include "drivers/files/system_user.h"

#include <pwd.h>
#include <unistd.h>

#include <array>

namespace instep {

std::optional<SystemUser> find_user(uid_t number) {
  std::array<char, 16384> text{};
  passwd entry{};
  passwd* found = nullptr;
  if (::getpwuid_r(number, &entry, text.data(), text.size(), &found) != 0 || found == nullptr) {
    return std::nullopt;
  }
  return SystemUser{found->pw_name, found->pw_gid};
}

std::string user_name(uid_t user) {
  const auto found = find_user(user);
  return found ? found->name : std::to_string(user);
}

std::string command_to_join(const std::string& group) {
  return "sudo usermod -aG " + group + " " + user_name(::geteuid());
}

}  // namespace instep
