#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "daemon/command_line/command_output.h"
#include "daemon/command_line/commands.h"
#include "daemon/command_line/file_ending.h"
#include "daemon/command_line/own_input.h"
#include "daemon/json/untrusted_json.h"
#include "daemon/repeat/repeat_report.h"
#include "daemon/repeat/repeat_study.h"
#include "daemon/repeat/repeat_svg.h"
#include "drivers/files/file_bytes.h"

namespace instep {
namespace {

constexpr std::size_t kLargestResultFile = 16 * 1024 * 1024;

constexpr const char* kExamples =
    R"(Scan the same foot several times (it steps off in between), then give all the results: folders
with a result.json, such files, or what 'instep measure' or 'instep replay' printed.

  mean |d|      of any two scans, the mean of their absolute difference: what studies of foot
                scanners report beside the 2 mm that ISO 20685-1 allows for dimensions of feet
  SD, range     standard deviation of the scans (n - 1), and their largest difference
  claimed 95 %  the mean of the intervals that the results claim: about twice the SD if they are true

It says how well scans agree, not how true they are: an error that all scans share does not show.
Left and right feet are taken apart. A measure that the results define differently is left out, and
results of different axes are refused. Examples:
  instep repeat /var/lib/instep/scans/2026/11/21/*
  instep repeat monday.json tuesday.json --format json
  instep repeat scans/* --plot repeat.svg)";

struct RepeatCommand {
  std::vector<std::string> results;
  std::string format;
  std::string plot;
};

Result<nlohmann::json> read_result(const std::filesystem::path& file) {
  const auto bytes = read_file_bytes(file, kLargestResultFile);
  if (!bytes) return tl::make_unexpected(bytes.error());
  auto result = object_in(*bytes);
  if (result.is_object()) return result;
  return fail(ErrorCode::kCorruptData, file.string() + " is no JSON object",
              "give a result.json, or leave this one out");
}

std::filesystem::path file_of(const std::filesystem::path& result) {
  std::error_code ignored;
  return std::filesystem::is_directory(result, ignored) ? result / "result.json" : result;
}

/// What `instep replay` prints holds a result for each foot.
Result<std::vector<StudiedResult>> read_results(const std::string& path) {
  auto result = read_result(file_of(path));
  if (!result) return tl::make_unexpected(result.error());
  if (!result->contains("results") || !(*result)["results"].is_array()) {
    return std::vector<StudiedResult>{{path, std::move(*result)}};
  }
  std::vector<StudiedResult> results;
  for (auto& one : (*result)["results"]) results.push_back({path, std::move(one)});
  return results;
}

Result<void> run(const RepeatCommand& command) {
  std::vector<StudiedResult> results;
  for (const auto& path : command.results) {
    if (auto spared = spare_input(command.plot, "--plot", file_of(path), "a result"); !spared) {
      return spared;
    }
    auto found = read_results(path);
    if (!found) return tl::make_unexpected(found.error());
    std::move(found->begin(), found->end(), std::back_inserter(results));
  }
  const auto study = study_repeats(results);
  if (!study) return tl::make_unexpected(study.error());
  if (!command.plot.empty()) {
    if (auto written = write_file_bytes(command.plot, repeat_svg(*study)); !written) return written;
  }
  const bool as_text = command.format.empty() ? stdout_is_terminal() : command.format == "text";
  return as_text ? print_text(repeat_text(*study)) : print_json(repeat_json(*study));
}

}  // namespace

void add_repeat_command(CLI::App& app, int& exit_code) {
  auto* repeat = app.add_subcommand("repeat", "Say how well repeated scans of one foot agree");
  repeat->footer(kExamples);
  const auto command = std::make_shared<RepeatCommand>();
  repeat->add_option("RESULT", command->results, "folder or file of a result; at least two")
      ->required();
  repeat->add_option("--format", command->format, "json (if stdout is no terminal) or text")
      ->check(CLI::IsMember({"json", "text"}));
  repeat
      ->add_option("--plot", command->plot,
                   "SVG file to write: each scan's deviation from the mean; an old one is replaced")
      ->check(FileEnding({".svg"}));
  repeat->callback([command, &exit_code] { exit_code = finish_command(run(*command)); });
}

}  // namespace instep
