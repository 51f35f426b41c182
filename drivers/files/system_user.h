#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace instep {

/// One that the system knows.
struct SystemUser {
  std::string name;
  gid_t group = 0;
};
std::optional<SystemUser> find_user(uid_t number);

/// The user's name, or number where the system knows none.
std::string user_name(uid_t user);

/// The command that lets the user of this program into a group. It names that user, who need not be
/// the one who reads it.
std::string command_to_join(const std::string& group);

}  // namespace instep
