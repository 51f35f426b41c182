#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "daemon/command_line/doctor/doctor_check.h"

namespace instep {

/// A line each, and one more with the remedy.
std::string to_text(const std::vector<DoctorCheck>& checks);

/// {"checks": [...]}; "good" is null of what was not looked at.
nlohmann::ordered_json to_json(const std::vector<DoctorCheck>& checks);

}  // namespace instep
