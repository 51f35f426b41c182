#include "daemon/command_line/clouds/measure_command.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "config/settings_search.h"
#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "core/noticed.h"
#include "daemon/command_line/clouds/cloud_options.h"
#include "daemon/command_line/clouds/measuring_options.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/file_ending.h"
#include "daemon/command_line/own_input.h"
#include "daemon/command_line/station_settings.h"
#include "daemon/page/pdf_page.h"
#include "daemon/page/report_page.h"
#include "daemon/report/result_json.h"
#include "daemon/report/text_report.h"
#include "daemon/scan/all_processors.h"
#include "drivers/files/file_bytes.h"

namespace instep {
namespace {

constexpr const char* kExamples =
    R"(No landmark is set by hand. JSON has landmarks, and the three points of each tape plane, in the foot's own
frame (pternion at the origin, x to the toes, z up); "frame" leads there from the cloud. Examples:
  instep measure foot.ply
  instep measure foot.stl --unit auto --side left --format text
  instep measure foot.ply --format csv > foot.csv
  instep measure foot.ply --axis brannock --ball-girth shortest
  instep measure foot.ply --report foot.pdf
A PDF is made by rsvg-convert (apt-get install librsvg2-bin), an SVG needs nothing.)";

struct MeasureCommand {
  CloudOptions cloud;
  std::string side = "auto";
  std::string format;
  std::string report;
  MeasuringOptions rules;
};

bool is_pdf(const std::string& file) {
  return has_ending(file, ".pdf");
}

Result<void> write_report(const ScanRecord& record, const MeasureCommand& command) {
  const auto page = report_page(record, std::filesystem::path(command.cloud.file).filename());
  if (!is_pdf(command.report)) return write_file_bytes(command.report, page);
  return pdf_of_page(page).and_then(
      [&](const std::string& pdf) { return write_file_bytes(command.report, pdf); });
}

Result<void> print_measures(const ScanRecord& record, const std::string& format) {
  const bool as_text = format.empty() ? stdout_is_terminal() : format == "text";
  if (as_text) return print_text(foot_text(record.foot, record.measures, record.sizes));
  const Json json = foot_json(record.foot, record.measures, record.sizes);
  return format == "csv" ? print_table(json) : print_json(json);
}

Result<void> run(const MeasureCommand& command) {
  auto spared = spare_input(command.report, "--report", command.cloud.file, "the cloud");
  if (!spared) return spared;
  const auto settings = measuring_settings();
  if (!settings) return tl::make_unexpected(settings.error());
  const auto file = read_cloud(command.cloud);
  if (!file) return tl::make_unexpected(file.error());
  AlignmentOptions options;
  options.side = side_from_string(command.side);
  options.rules = command.rules.over(settings->measures);
  auto foot = align_foot(file->cloud, options).and_then([](FootScan&& aligned) {
    return find_landmarks_by(on_all_processors, std::move(aligned));
  });
  if (!foot) return tl::make_unexpected(with_what_was_noticed(foot.error(), file->notes));
  foot->warnings.insert(foot->warnings.begin(), file->notes.begin(), file->notes.end());
  MeasureOptions measuring;
  measuring.workers = on_all_processors;
  auto measures = measure_foot(*foot, measuring);
  if (!measures)
    return tl::make_unexpected(with_what_was_noticed(measures.error(), foot->warnings));

  ScanRecord record;
  record.foot = std::move(*foot);
  record.sizes = shoe_sizes(record.foot, *measures, settings->sizes);
  record.measures = std::move(*measures);
  if (!command.report.empty()) {
    if (auto written = write_report(record, command); !written) return written;
  }
  return print_measures(record, command.format);
}

}  // namespace

void add_measure_command(CLI::App& app, int& exit_code) {
  auto* measure =
      app.add_subcommand("measure", "Length, breadths and girths of a foot in a cloud or mesh");
  measure->footer(std::string(kExamples) + "\n" + kMeasuringEnvironmentHelp);
  const auto command = std::make_shared<MeasureCommand>();
  add_cloud_options(*measure, command->cloud);
  measure->add_option("--side", command->side, "which foot it is; auto tells it from the shape")
      ->check(CLI::IsMember({"left", "right", "auto"}))
      ->capture_default_str();
  command->rules.add_to(*measure);
  measure->add_option("--format", command->format, "json (if stdout is no terminal), text or csv")
      ->check(CLI::IsMember({"json", "text", "csv"}));
  measure
      ->add_option("--report", command->report,
                   "one page to print, FILE.svg or FILE.pdf; an old one is replaced")
      ->check(FileEnding({".svg", ".pdf"}));
  measure->callback([command, &exit_code] { exit_code = finish_command(run(*command)); });
}

}  // namespace instep
