#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "core/result.h"
#include "daemon/command_line/doctor/doctor_check.h"

namespace instep {

/// Whom a daemon would run as that does not: where Instep is installed, not as root.
std::optional<uid_t> installed_user();

/// Of what is there, and whoever asks may not open. That is wrong where they are whom the daemon
/// runs as, or would: `daemon`, or else installed_user(). Of anybody else it tells nothing of the
/// station, and the remedy is how to look.
DoctorCheck closed_check(const char* name, const std::string& finding,
                         const std::string& advice_on_rights,
                         std::optional<uid_t> daemon = std::nullopt);

/// Of what failed when whoever asks opened it.
DoctorCheck failed_check(const char* name, const Error& error);

}  // namespace instep
