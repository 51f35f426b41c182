#pragma once

#include <string>

#include "config/settings.h"

namespace instep {

/// Where the real cameras' poses come from, as results say it: "instep calibrate, <its time>", "as
/// the settings say" or "by tape measure"; cameras that differ from the first of these are named
/// with theirs.
std::string source_of_poses(const Settings& settings);

/// What is to be said of real cameras that a tape measure alone placed, as a sentence that names
/// them and what to do; empty if there are none.
std::string warning_of_tape_measure(const Settings& settings);

}  // namespace instep
