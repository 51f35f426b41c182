#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "core/result.h"

namespace instep {

/// What `instep scan`, `status`, ... do: each talks to the daemon that the settings name, prints to
/// stdout, and fails with the one line that the user sees.

Result<void> scan_on_station(bool wait, bool as_json);
Result<void> show_station_status(std::optional<std::chrono::seconds> wait_ready, bool as_json);
/// Follows the station: a live line in a terminal, else JSON lines. Ends with the next result if
/// `until_result` is given (kTimeout if there is none by then), else never.
Result<void> watch_station(std::optional<std::chrono::seconds> until_result);
/// The ids, one a line; `with_details` what list_line() tells of each.
Result<void> list_scans(bool as_json, bool with_details);
/// `format`: text, json or csv.
Result<void> show_scan(const std::string& id, const std::string& format);
/// Copies the files of a scan into the folder <out>/<id>, which must not be there yet.
Result<void> export_scan(const std::string& id, const std::filesystem::path& out);
Result<void> delete_scan(const std::string& id);
Result<void> cancel_scan();

}  // namespace instep
