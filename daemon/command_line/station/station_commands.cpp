#include <CLI/CLI.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "config/settings_search.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/commands.h"
#include "daemon/command_line/station/station_talk.h"

namespace instep {
namespace {

/// What the options of one command were set to; shared with its callback.
struct Options {
  std::string id;
  std::string shown = "latest";
  std::string out = ".";
  std::string format = "text";
  bool no_wait = false;
  bool in_detail = false;
  int wait_ready_s = -1;
  int until_result_s = -1;

  bool as_json() const { return format == "json"; }
};

std::optional<std::chrono::seconds> limit(int seconds) {
  if (seconds < 0) return std::nullopt;
  return std::chrono::seconds(seconds);
}

struct StationCommands {
  CLI::App& app;
  int& exit_code;
  std::shared_ptr<Options> options = std::make_shared<Options>();

  /// Adds a command whose callback does `act` and turns its outcome into an exit code.
  CLI::App* add(const char* name, const char* what, const char* example,
                std::function<Result<void>(const Options&)> act) const {
    auto* command = app.add_subcommand(name, what);
    command->footer(std::string("Example:\n  ") + example + "\n\n" + kEnvironmentHelp);
    command->callback([given = options, act = std::move(act), &code = exit_code] {
      code = finish_command(act(*given));
    });
    return command;
  }
};

void add_format(CLI::App& command, Options& options) {
  command.add_option("--format", options.format, "text for people, json for programs")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
}

constexpr int kLongestWait_s = 86400;

void add_scan_commands(const StationCommands& commands) {
  Options& options = *commands.options;
  auto* scan = commands.add(
      "scan",
      "Start a scan, as the pedal does, and print its measures; of two feet JSON is "
      "{\"results\": [...]}",
      "instep scan", [](const Options& o) { return scan_on_station(!o.no_wait, o.as_json()); });
  scan->add_flag("--no-wait", options.no_wait, "Return as soon as the scan has begun");
  add_format(*scan, options);

  commands.add("cancel", "Cancel the scan that runs, as holding the pedal does", "instep cancel",
               [](const Options&) { return cancel_scan(); });

  auto* status = commands.add("status", "Say what the station is at and what is wrong with it",
                              "instep status --wait-ready 30", [](const Options& o) {
                                return show_station_status(limit(o.wait_ready_s), o.as_json());
                              });
  status
      ->add_option("--wait-ready", options.wait_ready_s, "Wait until it is ready, at most so long")
      ->type_name("SECONDS")
      ->check(CLI::Range(0, kLongestWait_s));
  add_format(*status, options);

  auto* watch = commands.add(
      "watch", "Follow the station: a live line in a terminal, JSON lines to a program",
      "instep watch --until-result 60",
      [](const Options& o) { return watch_station(limit(o.until_result_s)); });
  watch
      ->add_option("--until-result", options.until_result_s,
                   "End with the next result, or one of a moment ago; at most after so long")
      ->type_name("SECONDS")
      ->check(CLI::Range(0, kLongestWait_s));
}

void add_result_commands(const StationCommands& commands) {
  Options& options = *commands.options;
  auto* list = commands.add(
      "list",
      "List the scans, newest first: to a terminal with what they are known by, else the ids alone",
      "instep list --long | grep left", [](const Options& o) {
        if (o.in_detail && o.as_json()) throw CLI::ExcludesError("--long", "--format json");
        return list_scans(o.as_json(), o.in_detail || stdout_is_terminal());
      });
  list->add_flag("--long", options.in_detail,
                 "As to a terminal: time, side, length, ball girth, what is in doubt");
  add_format(*list, options);

  auto* show = commands.add("show", "Print the measures of a scan", "instep show latest",
                            [](const Options& o) { return show_scan(o.shown, o.format); });
  show->add_option("ID", options.shown, "The scan's id, or latest")->capture_default_str();
  show->add_option("--format", options.format, "text for people, json or csv for programs")
      ->check(CLI::IsMember({"text", "json", "csv"}))
      ->capture_default_str();

  auto* take = commands.add("export", "Copy a scan's files into a folder",
                            "instep export latest --out ~/scans",
                            [](const Options& o) { return export_scan(o.id, o.out); });
  take->add_option("ID", options.id, "The scan's id, or latest")->required();
  take->add_option("--out", options.out, "Folder to copy into: makes <out>/<id>")
      ->type_name("DIR")
      ->capture_default_str();

  auto* remove =
      commands.add("delete", "Delete a scan for good", "instep delete 20261121T091502417Z-k3f9",
                   [](const Options& o) { return delete_scan(o.id); });
  remove->add_option("ID", options.id, "The scan's id")->required();
}

}  // namespace

void add_station_commands(CLI::App& app, int& exit_code) {
  const StationCommands commands{app, exit_code};
  add_scan_commands(commands);
  add_result_commands(commands);
}

}  // namespace instep
