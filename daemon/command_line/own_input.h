#pragma once

#include <filesystem>
#include <string>

#include "core/result.h"

namespace instep {

/// Fails where the file to write, which `option` named, is the one that is read, by whatever name:
/// it would be lost to what is made of it. `what` it is, as in "the cloud".
Result<void> spare_input(const std::filesystem::path& out, const std::string& option,
                         const std::filesystem::path& input, const std::string& what);

}  // namespace instep
