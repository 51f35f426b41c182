#include "daemon/command_line/recordings/record_command.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "config/settings_file.h"
#include "config/settings_search.h"
#include "daemon/cloud_files/text_tokens.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/recordings/station_recording.h"
#include "daemon/command_line/stop_request.h"

namespace instep {
namespace {

constexpr const char* kExamples =
    R"(Stop the daemon first: a camera has one reader. Frames that a scan would leave out are left out
here too: the first capture.warmup_frames of each camera, and faulty ones. Cameras take turns, each
for the whole length, where capture.one_at_a_time is set. The times of all frames are on one clock.
Examples:
  instep record --out visit --config /etc/instep/instep.toml --frames 15
  instep record --out visit --config /etc/instep/instep.toml --seconds 3)";

struct RecordCommand {
  std::string folder;
  std::string config;
  std::optional<std::size_t> frames;
  std::optional<double> seconds;
};

std::string check_seconds(const std::string& text) {
  const auto seconds = number_in(text);
  return seconds && *seconds >= 0.001 && *seconds <= 600.0 ? ""
                                                           : "needs a number from 0.001 to 600";
}

RecordingLength length_of(const RecordCommand& command) {
  constexpr std::size_t kUsualFrames = 15;
  RecordingLength length;
  length.frames_per_camera = command.frames;
  if (command.seconds) {
    length.time = std::chrono::milliseconds(static_cast<long>(*command.seconds * 1000.0));
  } else if (!command.frames) {
    length.frames_per_camera = kUsualFrames;
  }
  return length;
}

Result<void> run(const RecordCommand& command) {
  auto settings = load_settings(command.config);
  if (!settings) return tl::make_unexpected(settings.error());
  override_paths(*settings, process_environment);  // as the daemon's, which may have the cameras
  const StopRequest stop;                          // a killed program would leave the light on
  const auto recording = record_station(*settings, length_of(command), command.folder, stop);
  if (!recording) return tl::make_unexpected(recording.error());
  return print_json({{"folder", command.folder},
                     {"simulated", recording->simulated},
                     {"cameras", recording->cameras.size()},
                     {"frames", recording->frames.size()}});
}

}  // namespace

void add_record_command(CLI::App& app, int& exit_code) {
  auto* record = app.add_subcommand("record", "Record what the cameras of a station see");
  record->footer(kExamples);
  const auto command = std::make_shared<RecordCommand>();
  record->add_option("--out", command->folder, "folder to make")->required();
  record->add_option("--config", command->config, "settings file of the station, with its cameras")
      ->required();
  record
      ->add_option(
          "--frames", command->frames,
          "how many each camera takes (15 if nothing is said, as a scan does; one takes 120 at "
          "the most)")
      ->check(CLI::Range(1, 10000));
  record
      ->add_option("--seconds", command->seconds, "how long each camera records, by its own clock")
      ->check(check_seconds);
  record->callback([command, &exit_code] { exit_code = finish_command(run(*command)); });
}

}  // namespace instep
