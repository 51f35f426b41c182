#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace instep {

/// Whether the folder's owner, group and mode let the user make something in it. True where there
/// is an access list, which is not read, or the folder cannot be looked at: nothing is known then.
bool may_write_in(const std::filesystem::path& folder, uid_t user);

/// The command that lets the user write in the folder, which gives it to them if it is another's.
std::string advice_to_give(const std::filesystem::path& folder, uid_t user);

}  // namespace instep
