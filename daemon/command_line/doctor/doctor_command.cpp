#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/settings_search.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/commands.h"
#include "daemon/command_line/doctor/doctor_checks.h"

namespace instep {
namespace {

std::string as_text(const std::vector<DoctorCheck>& checks) {
  std::string text;
  for (const auto& check : checks) {
    text +=
        fmt::format("{:<5} {:<11} {}\n", check.good ? "ok" : "WRONG", check.name, check.finding);
    if (!check.good) text += fmt::format("      {:<11} -> {}\n", "", check.remedy);
  }
  return text;
}

nlohmann::ordered_json as_json(const std::vector<DoctorCheck>& checks) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& check : checks) {
    list.push_back({{"name", check.name},
                    {"good", check.good},
                    {"finding", check.finding},
                    {"remedy", check.remedy}});
  }
  return {{"checks", list}};
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
    const auto wrong =
        std::count_if(checks.begin(), checks.end(), [](const auto& one) { return !one.good; });
    auto outcome = *format == "json" ? print_json(as_json(checks)) : print_text(as_text(checks));
    if (outcome && wrong > 0) {
      outcome = fail(ErrorCode::kInvalidInput,
                     fmt::format("{} of {} checks failed", wrong, checks.size()),
                     "do what stands behind the arrows");
    }
    exit_code = finish_command(outcome);
  });
}

}  // namespace instep
