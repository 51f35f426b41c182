#include "daemon/command_line/measure_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "daemon/command_line/cloud_options.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/station_settings.h"
#include "daemon/report/csv_report.h"
#include "daemon/report/result_json.h"
#include "daemon/report/text_report.h"

namespace instep {
namespace {

constexpr const char* kExamples = R"(No landmark is set by hand. Examples:
  instep measure foot.ply
  instep measure foot.stl --unit auto --side left --format text
  instep measure foot.ply --format csv > foot.csv)";

struct MeasureCommand {
  CloudOptions cloud;
  std::string side = "auto";
  std::string format;
};

Result<void> run(const MeasureCommand& command) {
  const auto file = read_cloud(command.cloud);
  if (!file) return tl::make_unexpected(file.error());
  AlignmentOptions options;
  options.side = side_from_string(command.side);
  auto foot = align_foot(file->cloud, options).and_then(find_landmarks);
  if (!foot) return tl::make_unexpected(foot.error());
  foot->warnings.insert(foot->warnings.begin(), file->notes.begin(), file->notes.end());
  const auto measures = measure_foot(*foot);
  if (!measures) return tl::make_unexpected(measures.error());

  const auto sizes = shoe_sizes(sized_foot(*measures), station_settings().sizes);

  if (command.format == "csv") return print_text(foot_csv(*foot, *measures));
  const bool as_text = command.format.empty() ? stdout_is_terminal() : command.format == "text";
  return as_text ? print_text(foot_text(*foot, *measures, sizes))
                 : print_json(foot_json(*foot, *measures, sizes));
}

}  // namespace

void add_measure_command(CLI::App& app, int& exit_code) {
  auto* measure =
      app.add_subcommand("measure", "Length, breadths and girths of a foot in a cloud or mesh");
  measure->footer(kExamples);
  const auto command = std::make_shared<MeasureCommand>();
  add_cloud_options(*measure, command->cloud);
  measure->add_option("--side", command->side, "which foot it is; auto tells it from the shape")
      ->check(CLI::IsMember({"left", "right", "auto"}))
      ->capture_default_str();
  measure->add_option("--format", command->format, "json (if stdout is no terminal), text or csv")
      ->check(CLI::IsMember({"json", "text", "csv"}));
  measure->callback([command, &exit_code] { exit_code = finish_command(run(*command)); });
}

}  // namespace instep
