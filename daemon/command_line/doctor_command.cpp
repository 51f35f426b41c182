#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/settings_search.h"
#include "daemon/command_line/commands.h"
#include "daemon/command_line/doctor_checks.h"

namespace instep {
namespace {

void print_text(const std::vector<DoctorCheck>& checks) {
  for (const auto& check : checks) {
    fmt::print("{:<5} {:<9} {}\n", check.good ? "ok" : "WRONG", check.name, check.finding);
    if (!check.good) fmt::print("      {:<9} -> {}\n", "", check.remedy);
  }
}

void print_json(const std::vector<DoctorCheck>& checks) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& check : checks) {
    list.push_back({{"name", check.name},
                    {"good", check.good},
                    {"finding", check.finding},
                    {"remedy", check.remedy}});
  }
  const nlohmann::json report = {{"checks", list}};
  fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

void add_doctor_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "doctor", "Say what is wrong with this machine, and the command that puts it right");
  const auto format = std::make_shared<std::string>("text");
  command->add_option("--format", *format, "text for people, json for programs")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  command->footer(std::string("Changes nothing. Exit code 1 if anything is wrong.\n\n") +
                  kEnvironmentHelp);
  command->callback([format, &exit_code] {
    const auto checks = examine_machine();
    *format == "json" ? print_json(checks) : print_text(checks);
    const auto wrong =
        std::count_if(checks.begin(), checks.end(), [](const auto& one) { return !one.good; });
    if (wrong > 0) {
      fmt::print(stderr, "instep: {} of {} checks failed: do what stands behind the arrows\n",
                 wrong, checks.size());
    }
    exit_code = wrong > 0 ? 1 : 0;
  });
}

}  // namespace instep
