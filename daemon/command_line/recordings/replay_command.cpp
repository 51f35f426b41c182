#include "daemon/command_line/recordings/replay_command.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "config/settings_search.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/result_text.h"
#include "daemon/command_line/station_settings.h"
#include "daemon/json/untrusted_json.h"
#include "daemon/report/pair_report.h"
#include "daemon/scan/recorded_capture.h"
#include "daemon/scan/scan_pipeline.h"
#include "daemon/store/posix_storage.h"
#include "daemon/store/put_together.h"
#include "daemon/store/result_content.h"
#include "daemon/store/result_store.h"
#include "drivers/files/file_bytes.h"

namespace instep {
namespace {

using json = nlohmann::ordered_json;

constexpr const char* kExamples =
    R"(JSON is {"results": [...]}, one object for each foot; if there are two, each has both side by side
under "pair". Examples:
  instep replay visit --format text
  instep replay visit --out results --side left
  instep replay visit --poses trust        (the given ones are better than the views can tell))";

struct ReplayCommand {
  std::string recording;
  std::string out;
  std::string side = "auto";
  std::string poses = "refine";
  std::string format;
};

Result<std::vector<NamedContent>> contents_of(const std::vector<ScanRecord>& records) {
  std::vector<NamedContent> contents;
  for (const auto& record : records) {
    auto content = content_of(record);
    if (!content) return tl::make_unexpected(content.error());
    contents.push_back({record.id, std::move(*content)});
  }
  return contents;
}

/// An object for each result.
Result<json> objects_of(const std::vector<NamedContent>& contents) {
  json results = json::array();
  for (const auto& one : contents) {
    json result = object_in(one.content.result_json);
    if (!result.is_object()) {
      return fail(ErrorCode::kInternal, "a result is no JSON object", "report this");
    }
    result["folder"] = nullptr;
    results.push_back(std::move(result));
  }
  return results;
}

std::string text_of(const json& results) {
  std::string text;
  for (const auto& result : results) text += result_text(result);
  return results.empty() ? text : text + pair_text(results.back().value("pair", json()));
}

tl::unexpected<Error> of_out(Error error) {
  const bool is_full = error.code == ErrorCode::kNoSpace;
  error.advice = is_full ? "make room there, or choose another --out" : "choose another --out";
  return tl::make_unexpected(std::move(error));
}

/// Both feet or none. Adds their folders to their objects.
Result<void> keep(ResultStore& store, const std::vector<NamedContent>& contents, json& results) {
  const auto folders = put_together(store, contents, [] {});
  if (!folders) return of_out(folders.error());
  for (std::size_t i = 0; i < folders->size(); ++i) {
    results[i]["folder"] = (*folders)[i].string();
  }
  return {};
}

/// Before the long work, so that nothing is measured in vain.
Result<void> make_ready(ResultStore& store, const std::filesystem::path& folder) {
  std::error_code failed;
  const auto parent = folder.parent_path();
  if (!parent.empty()) std::filesystem::create_directories(parent, failed);
  if (failed) return of_out(file_error(failed.value(), "make", parent));
  const auto prepared = store.prepare();
  if (!prepared) return of_out(prepared.error());
  return {};
}

Result<void> run(const ReplayCommand& command) {
  const auto station = measuring_settings();
  if (!station) return tl::make_unexpected(station.error());
  const auto capture = read_capture(command.recording);
  if (!capture) return tl::make_unexpected(capture.error());
  ResultStore store(std::make_shared<PosixStorage>(), command.out);
  if (!command.out.empty()) {
    if (auto ready = make_ready(store, command.out); !ready) return ready;
  }

  PipelineSettings settings;
  settings.station = "replay";
  settings.sizes = station->sizes;
  settings.measures = station->measures;
  settings.side = side_from_string(command.side);
  settings.refine_views = command.poses != "trust";
  ProgressLine line;
  const auto records =
      measure_capture(*capture, settings, [&](std::string_view stage, double done) {
        line.show(stage, done);
        return true;
      });
  if (!records) return tl::make_unexpected(records.error());

  const auto contents = contents_of(*records);
  if (!contents) return tl::make_unexpected(contents.error());
  auto results = objects_of(*contents);
  if (!results) return tl::make_unexpected(results.error());
  if (!command.out.empty()) {
    if (auto kept = keep(store, *contents, *results); !kept) return kept;
  }
  const bool as_text = command.format.empty() ? stdout_is_terminal() : command.format == "text";
  return as_text ? print_text(text_of(*results)) : print_json({{"results", *results}});
}

}  // namespace

void add_replay_command(CLI::App& app, int& exit_code) {
  auto* replay = app.add_subcommand("replay", "Measure the feet of a recording, without a daemon");
  replay->footer(std::string(kExamples) + "\n" + kMeasuringEnvironmentHelp);
  const auto command = std::make_shared<ReplayCommand>();
  replay->add_option("RECORDING", command->recording, "folder of a recording")->required();
  replay
      ->add_option("--out", command->out,
                   "folder to keep the results in; else they are only printed")
      ->check([](const std::string& folder) {
        return std::string(folder.empty() ? "needs the name of a folder" : "");
      });
  replay->add_option("--side", command->side, "which foot it is; auto tells it from the shape")
      ->check(CLI::IsMember({"left", "right", "auto"}))
      ->capture_default_str();
  replay
      ->add_option("--poses", command->poses,
                   "refine the cameras' poses and lenses by fitting the views to each other, or "
                   "trust them; auto is refine")
      ->check(CLI::IsMember({"refine", "trust", "auto"}))
      ->capture_default_str();
  replay->add_option("--format", command->format, "json (if stdout is no terminal) or text")
      ->check(CLI::IsMember({"json", "text"}));
  replay->callback([command, &exit_code] { exit_code = finish_command(run(*command)); });
}

}  // namespace instep
