#include "daemon/command_line/doctor/closed_check.h"

#include <pwd.h>
#include <unistd.h>

#include "drivers/files/system_user.h"

namespace instep {

std::optional<uid_t> installed_user() {
  const auto* user = ::getpwnam("instep");
  return user != nullptr ? std::optional(user->pw_uid) : std::nullopt;
}

DoctorCheck closed_check(const char* name, const std::string& finding,
                         const std::string& advice_on_rights, std::optional<uid_t> daemon) {
  const auto opener = daemon ? daemon : installed_user();
  if (opener == ::geteuid()) return bad_check(name, finding, advice_on_rights);
  return unseen_check(
      name, "not looked at: " + finding,
      opener ? "sudo -u " + user_name(*opener) + " instep doctor" : advice_on_rights);
}

DoctorCheck failed_check(const char* name, const Error& error) {
  if (error.code == ErrorCode::kPermissionDenied) {
    return closed_check(name, error.message, error.advice);
  }
  return bad_check(name, error.message, error.advice);
}

}  // namespace instep
