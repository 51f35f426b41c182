#pragma once

#include <filesystem>

namespace instep {

/// The version of this software, such as "0.1.0".
const char* program_version();

/// The source tree it was built from; it need not exist on the machine that runs it.
std::filesystem::path source_folder();

}  // namespace instep
