#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "config/settings_search.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/commands.h"
#include "daemon/command_line/doctor/doctor_checks.h"
#include "daemon/command_line/doctor/doctor_report.h"

namespace instep {

void add_doctor_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "doctor", "Say what is wrong with this machine, and the command that puts it right");
  const auto format = std::make_shared<std::string>("text");
  command->add_option("--format", *format, "text for people, json for programs")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  command->footer(
      std::string("Changes nothing. Exit code 1 if anything is wrong. What you may not look at is "
                  "marked \"?\",\nin JSON \"good\": null: it is not known to be wrong.\n\n") +
      kEnvironmentHelp);
  command->callback([format, &exit_code] {
    const auto checks = examine_machine();
    const auto wrong =
        std::count_if(checks.begin(), checks.end(), [](const auto& one) { return one.is_wrong(); });
    auto outcome = *format == "json" ? print_json(to_json(checks)) : print_text(to_text(checks));
    if (outcome && wrong > 0) {
      outcome = fail(ErrorCode::kInvalidInput,
                     fmt::format("{} of {} checks failed", wrong, checks.size()),
                     "do what stands behind the arrows");
    }
    exit_code = finish_command(outcome);
  });
}

}  // namespace instep
