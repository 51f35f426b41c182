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
  const auto format = std::make_shared<std::string>();
  command->add_option("--format", *format, "json (if stdout is no terminal) or text")
      ->check(CLI::IsMember({"json", "text"}));
  command->footer(std::string("Says what the settings need to name a device: serial number, place "
                              "on the bus, line,\nids. Takes no device from who uses it; OpenNI2 "
                              "sensors that nobody uses are opened\n"
                              "for a second, for their serial numbers.\n\n") +
                  kEnvironmentHelp);
  command->callback([format, &exit_code] {
    constexpr std::chrono::seconds kOpenniLimit{10};
    const Settings settings = station_settings();
    if (const auto found = find_uncalibrated_station_settings(); !found) {
      fmt::print(stderr, "instep: nothing is known to be configured: {}\n", found.error().line());
    }
    const auto openni =
        look_through_openni(settings, running_program_folder() / "instep-openni", kOpenniLimit);
    const auto inventory = take_inventory(settings, {}, linux_video_system(), openni);
    const bool as_text = format->empty() ? stdout_is_terminal() : *format == "text";
    exit_code = finish_command(as_text ? print_text(to_text(inventory, settings))
                                       : print_json(to_json(inventory, settings)));
  });
}

}  // namespace instep
