#pragma once

#include <filesystem>

namespace instep::test {

/// Folder of the trial data (shapes, feet, lasts, real frames); tests skip where it is absent.
std::filesystem::path trial_data();

/// Folder of the built programs.
std::filesystem::path built_programs();

/// Root of the source tree.
std::filesystem::path source_tree();

}  // namespace instep::test
