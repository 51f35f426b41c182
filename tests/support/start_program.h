#pragma once

#include <spawn.h>
#include <sys/types.h>

#include <string>
#include <vector>

namespace instep::test {

/// Starts one of this project's programs with arguments, its descriptors as `actions` say, which
/// are destroyed; throws if it cannot start.
pid_t start_program(const std::string& name, const std::vector<std::string>& arguments,
                    posix_spawn_file_actions_t& actions);

}  // namespace instep::test
