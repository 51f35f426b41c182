#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "config/settings_search.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/commands.h"
#include "daemon/command_line/station_settings.h"
#include "daemon/machine/inventory_report.h"

namespace instep {

void add_devices_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "devices", "List the cameras, GPIO lines and foot switches that are plugged in");
  const auto format = std::make_shared<std::string>(stdout_is_terminal() ? "text" : "json");
  command->add_option("--format", *format, "text for people, json for programs")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  command->footer(std::string("Says what the settings need to name a device: serial number, place "
                              "on the bus, line,\nids. Takes no device from who uses it; OpenNI2 "
                              "sensors that nobody uses are opened\n"
                              "for a second, for their serial numbers.\n\n") +
                  kEnvironmentHelp);
  command->callback([format, &exit_code] {
    constexpr std::chrono::seconds kOpenniLimit{10};
    const Settings settings = station_settings();
    if (const auto found = find_station_settings(); !found) {
      fmt::print(stderr, "instep: nothing is known to be configured: {}\n", found.error().line());
    }
    const auto openni =
        look_through_openni(settings, running_program_folder() / "instep-openni", kOpenniLimit);
    const auto inventory = take_inventory(settings, {}, linux_video_system(), openni);
    exit_code = finish_command(*format == "json" ? print_json(to_json(inventory, settings))
                                                 : print_text(to_text(inventory, settings)));
  });
}

}  // namespace instep
