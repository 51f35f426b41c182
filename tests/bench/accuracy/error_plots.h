#pragma once

#include <filesystem>

namespace instep::bench {

/// Measures simulated feet, and lasts where the trial data is present, by all methods over density
/// and over noise, and writes the plots into a folder.
void write_error_plots(const std::filesystem::path& folder);

}  // namespace instep::bench
