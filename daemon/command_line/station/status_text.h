#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace instep {

/// The answer of the daemon to "status", in words. What is of another shape is left out.

/// One line without its end: state, stage and what is wrong.
std::string status_line(const nlohmann::json& status);

/// The same to be written over and over in one line of a terminal: with a bar while a scan runs.
std::string live_line(const nlohmann::json& status);

/// All of it: that line, one for each camera and for each lamp, and the counts. Lamps that are away
/// for one cause stand on one line.
std::string status_text(const nlohmann::json& status);

}  // namespace instep
