#include "daemon/command_line/station/station_talk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "config/settings_search.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/result_text.h"
#include "daemon/command_line/station/list_text.h"
#include "daemon/command_line/station/status_text.h"
#include "daemon/command_line/station_settings.h"
#include "daemon/control/control_client.h"
#include "daemon/control/protocol.h"
#include "daemon/json/untrusted_json.h"
#include "daemon/report/pair_report.h"
#include "drivers/files/file_bytes.h"

namespace instep {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

/// Far longer than a scan with its deadlines can take.
constexpr seconds kLongestScan{300};
constexpr std::size_t kMostExportedBytes = std::size_t{1} << 30;

Result<ControlClient> reach_daemon() {
  auto client = ControlClient::connect(station_settings().control.socket);
  if (client || client.error().code != ErrorCode::kNotFound) return client;
  // It may well run, on the socket that those settings name.
  const bool is_named = process_environment("INSTEP_SOCKET").has_value();
  const auto passed_over = is_named ? std::nullopt : passed_over_settings();
  if (!passed_over) return client;
  std::string faults = passed_over->message;
  std::replace(faults.begin(), faults.end(), '\n', ';');
  return fail(passed_over->code,
              "the settings that name the daemon's socket cannot be read: " + faults,
              "correct them, then: instepd --check");
}

/// One request on a connection of its own.
Result<json> ask_daemon(const std::string& verb, const std::string& id = {}) {
  auto client = reach_daemon();
  if (!client) return tl::make_unexpected(client.error());
  return client->ask(verb, id);
}

Result<json> stored_result(ControlClient& client, const std::string& id) {
  auto shown = client.ask("show", id);
  if (!shown) return shown;
  const auto result = shown->find("result");
  if (result == shown->end() || !result->is_object()) {
    return tl::make_unexpected(answer_not_understood());
  }
  return std::move(*result);
}

/// Nobody who waits comes to be let in, nor turns another file into a socket.
bool is_in_vain(const Error& error) {
  return error.code == ErrorCode::kPermissionDenied || error.code == ErrorCode::kInvalidInput;
}

/// Until the station is ready, it is late, or to wait is in vain.
void wait_until_ready(milliseconds limit) {
  constexpr milliseconds kLongestPause{1000};
  const auto socket = station_settings().control.socket;
  const auto deadline = steady_clock::now() + limit;
  milliseconds pause{50};
  while (true) {
    const auto status = ControlClient::connect(socket).and_then(
        [](ControlClient&& client) { return client.ask("status"); });
    if (status ? string_at(*status, "state") == "ready" : is_in_vain(status.error())) return;
    const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now());
    if (left.count() <= 0) return;
    std::this_thread::sleep_for(std::min(pause, left));
    pause = std::min(2 * pause, kLongestPause);
  }
}

/// The result or failure that the next scan ends with.
Result<json> wait_for_end(ControlClient& client, milliseconds limit) {
  const auto deadline = steady_clock::now() + limit;
  while (true) {
    auto line = client.next(std::chrono::ceil<milliseconds>(deadline - steady_clock::now()));
    if (!line) return line;
    const auto event = string_at(*line, "event");
    if (event == "result") return line;
    if (event == "failure") {
      (*line)["ok"] = false;
      return tl::make_unexpected(answer_outcome(*line).error());
    }
  }
}

std::string told_in_terminal(const json& line) {
  const auto event = string_at(line, "event");
  std::string told;
  if (event == "result") {
    for (const auto& scan : list_at(line, "scans")) {
      told += fmt::format("\r\033[Kscan {} ({} foot)\n", string_at(scan, "id"),
                          string_at(scan, "side"));
    }
  } else if (event == "failure") {
    const json error = line.value("error", json::object());
    told = fmt::format("\r\033[Kno scan: {}: {}\n", string_at(error, "message"),
                       string_at(error, "advice"));
  } else if (event == "status" || event.empty()) {
    told = live_line(line);
  }
  return told;
}

Result<void> tell(const json& line, bool in_terminal) {
  return print_text(in_terminal ? told_in_terminal(line)
                                : line.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
}

/// Of the disk or of the daemon, so that the next scan fares no better.
bool ends_list(const Error& error) {
  return error.code == ErrorCode::kDeviceGone || error.code == ErrorCode::kTimeout ||
         error.code == ErrorCode::kBusy;
}

/// Line by line, as there may be thousands, and the newest are what is mostly looked for.
Result<void> list_in_detail(ControlClient& client, const json& scans) {
  for (const auto& scan : scans) {
    const std::string id = string_at(scan, "id");
    const auto result = stored_result(client, id);
    if (!result && result.error().code == ErrorCode::kNotFound) {
      // Deleted meanwhile, or it went with the folder of all results.
      if (const auto others = client.ask("list"); !others)
        return tl::make_unexpected(others.error());
      continue;
    }
    if (!result && ends_list(result.error())) return tl::make_unexpected(result.error());
    const auto printed = print_text(result ? list_line(id, *result)
                                           : list_line_without_result(id, result.error().message));
    if (!printed) return printed;
  }
  return {};
}

/// Of a file in a scan's folder, and never of one elsewhere.
Result<std::string> name_of(const json& file) {
  if (!file.is_string()) return tl::make_unexpected(answer_not_understood());
  auto name = file.get<std::string>();
  if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos) {
    return tl::make_unexpected(answer_not_understood());
  }
  return name;
}

/// Copies files into a folder that was made for them; takes it away again if that fails.
Result<void> fill_folder(const json& files, const std::filesystem::path& from,
                         const std::filesystem::path& to) {
  for (const auto& file : files) {
    const auto copied = name_of(file).and_then([&](const std::string& name) {
      return read_file_bytes(from / name, kMostExportedBytes)
          .and_then([&](const std::string& bytes) { return write_file_bytes(to / name, bytes); });
    });
    if (copied) continue;
    std::error_code ignored;
    std::filesystem::remove_all(to, ignored);
    return copied;
  }
  return {};
}

}  // namespace

Result<void> scan_on_station(bool wait, bool as_json) {
  auto client = reach_daemon();
  if (!client) return tl::make_unexpected(client.error());
  // Watching before scanning, so that not even the quickest scan is missed.
  if (wait) {
    if (const auto watching = client->ask("watch"); !watching) {
      return tl::make_unexpected(watching.error());
    }
  }
  if (const auto begun = client->ask("scan"); !begun) return tl::make_unexpected(begun.error());
  if (!wait) return {};
  const auto end = wait_for_end(*client, kLongestScan);
  if (!end) return tl::make_unexpected(end.error());
  auto asking = reach_daemon();
  if (!asking) return tl::make_unexpected(asking.error());
  json results = json::array();
  for (const auto& scan : list_at(*end, "scans")) {
    auto result = stored_result(*asking, string_at(scan, "id"));
    if (!result) return tl::make_unexpected(result.error());
    results.push_back(std::move(*result));
  }
  if (as_json) return print_json(results.size() == 1 ? results[0] : json{{"results", results}});
  std::string text;
  for (const auto& result : results) text += result_text(result);
  if (!results.empty()) text += pair_text(results.back().value("pair", json()));
  return print_text(text);
}

Result<void> show_station_status(std::optional<seconds> wait_ready, bool as_json) {
  if (wait_ready) wait_until_ready(*wait_ready);
  const auto status = ask_daemon("status");
  if (!status) return tl::make_unexpected(status.error());
  const bool is_late = wait_ready && string_at(*status, "state") != "ready";
  if (is_late) {
    return fail(ErrorCode::kTimeout, "the station is not ready but " + status_line(*status),
                "see what it waits for: instep status");
  }
  return as_json ? print_json(*status) : print_text(status_text(*status));
}

Result<void> watch_station(std::optional<seconds> until_result) {
  auto client = reach_daemon();
  if (!client) return tl::make_unexpected(client.error());
  const bool in_terminal = stdout_is_terminal();
  const auto first = client->ask("watch");
  if (!first) return tl::make_unexpected(first.error());
  if (const auto told = tell(*first, in_terminal); !told) return told;
  const auto deadline = steady_clock::now() + until_result.value_or(seconds(0));
  while (true) {
    const auto left = until_result ? std::chrono::ceil<milliseconds>(deadline - steady_clock::now())
                                   : milliseconds(std::chrono::hours(24));
    const auto line = client->next(left);
    if (!line && line.error().code == ErrorCode::kTimeout && !until_result) continue;
    if (!line && line.error().code == ErrorCode::kTimeout) {
      return fail(ErrorCode::kTimeout, "there was no result in time", "see why: instep status");
    }
    if (!line) return tl::make_unexpected(line.error());
    if (const auto told = tell(*line, in_terminal); !told) return told;
    if (until_result && string_at(*line, "event") == "result") return {};
  }
}

Result<void> list_scans(bool as_json, bool with_details) {
  auto client = reach_daemon();
  if (!client) return tl::make_unexpected(client.error());
  const auto answer = client->ask("list");
  if (!answer) return tl::make_unexpected(answer.error());
  const json scans = list_at(*answer, "scans");
  if (as_json) return print_json({{"scans", scans}});
  if (with_details) return list_in_detail(*client, scans);
  std::string ids;
  for (const auto& scan : scans) ids += string_at(scan, "id") + "\n";
  return print_text(ids);
}

Result<void> show_scan(const std::string& id, const std::string& format) {
  auto client = reach_daemon();
  if (!client) return tl::make_unexpected(client.error());
  const auto result = stored_result(*client, id);
  if (!result) return tl::make_unexpected(result.error());
  if (format == "json") return print_json(*result);
  if (format == "csv") return print_table(*result);
  return print_text(result_text(*result) + pair_text(result->value("pair", json())));
}

Result<void> export_scan(const std::string& id, const std::filesystem::path& out) {
  const auto answer = ask_daemon("export", id);
  if (!answer) return tl::make_unexpected(answer.error());
  const auto name = name_of(answer->value("id", json()));
  if (!name) return tl::make_unexpected(name.error());
  const std::filesystem::path from = string_at(*answer, "folder");
  const auto to = out / *name;
  std::error_code failed;
  std::filesystem::create_directories(out, failed);
  const bool made = !failed && std::filesystem::create_directory(to, failed);
  if (failed) return tl::make_unexpected(file_error(failed.value(), "make", to));
  if (!made) {
    return fail(ErrorCode::kBusy, to.string() + " is there already",
                "move it away, or choose another --out");
  }
  // A scan is personal: only who may read it in the store may read the copy.
  std::filesystem::permissions(to, std::filesystem::perms::others_all,
                               std::filesystem::perm_options::remove, failed);
  const auto filled = fill_folder(list_at(*answer, "files"), from, to);
  if (!filled) return filled;
  return print_text(to.string() + "\n");
}

Result<void> delete_scan(const std::string& id) {
  const auto answer = ask_daemon("delete", id);
  if (!answer) return tl::make_unexpected(answer.error());
  const auto pair = string_at(*answer, "pair");
  if (pair.empty()) return {};
  return print_text("the scan of the other foot still holds the numbers of both: instep delete " +
                    pair + "\n");
}

Result<void> cancel_scan() {
  const auto answer = ask_daemon("cancel");
  if (!answer) return tl::make_unexpected(answer.error());
  return {};
}

}  // namespace instep
