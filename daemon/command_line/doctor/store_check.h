#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>

#include "daemon/command_line/doctor/doctor_check.h"

namespace instep {

/// Whether the user that `daemon` runs as can keep results there; without one, by whose the folder
/// is.
DoctorCheck check_store(const std::filesystem::path& root, std::optional<uid_t> daemon);

}  // namespace instep
