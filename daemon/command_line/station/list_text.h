#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace instep {

/// One line of a list of scans, for a person who looks for one: the id first, as commands take it,
/// then the time by this machine's zone, side, length and ball girth with their 95 % intervals, and
/// how much was withheld or is noted. Takes what result.json holds; what is missing there is told
/// as such.
std::string list_line(const std::string& id, const nlohmann::json& result);

/// The same of a scan whose result cannot be read, with the reason.
std::string list_line_without_result(const std::string& id, const std::string& reason);

}  // namespace instep
