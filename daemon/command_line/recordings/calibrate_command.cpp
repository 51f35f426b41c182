#include "daemon/command_line/recordings/calibrate_command.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "config/calibration/calibration_file.h"
#include "config/settings_file.h"
#include "config/settings_search.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/recordings/calibration_report.h"
#include "daemon/command_line/recordings/calibration_target.h"
#include "daemon/command_line/recordings/scratch_folder.h"
#include "daemon/command_line/recordings/station_recording.h"
#include "daemon/command_line/station_settings.h"
#include "daemon/command_line/stop_request.h"
#include "daemon/scan/all_processors.h"
#include "daemon/scan/camera_images.h"
#include "daemon/scan/recorded_capture.h"
#include "daemon/scan/stage_clock.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFrames = 30;  // a camera, of a station that is calibrated itself

constexpr const char* kHelp =
    R"(How: stand one thing as large as a foot, neither round nor a block with flat faces such as a box,
alone in the middle of the platform: a last or a shoe. Stop the daemon, and run this; nobody may
touch the thing while it runs. Every camera has to see the thing from its side and the platform
round it; four cameras round it do. A camera of two that face each other alone usually cannot be
told: add a third between. Nothing else that is level near the platform's height, such as the floor
beside a small platform, and no wall or leg within half a metre may be in view.

The settings have to say roughly where each camera stands, within some 15 cm and 25 degrees: a tape
will do (stands_at_mm and looks_at_mm in config/instep.toml). Nothing about the thing need be known.

The poses go to calibration.toml beside the settings, which have them from there. Of a RECORDING
(instep record) they are printed alone, unless --out names a file. Poses that the cameras leave
open, or contradict, are not written; what was there before stays, and so does a file for --out that
holds something else than a calibration.
Examples:
  instep calibrate                            the station of this machine
  instep calibrate --config my/instep.toml    another one's settings
  instep calibrate visit --format text        what a recording tells
)";

struct CalibrateCommand {
  std::string recording;
  std::string config;
  std::string out;
  std::string format;
};

/// What is calibrated, and what is to come of its poses.
struct Subject {
  Capture capture;
  std::optional<CalibrationTarget> target;
  PosesUse use = PosesUse::kPrinted;  ///< once they are written, if there is a target
};

Error stopped() {
  return {ErrorCode::kCancelled, usual_remedy(ErrorCode::kCancelled),
          "the calibration was stopped, nothing was written", "calibrate again when you are ready"};
}

/// What is shared with scans tells to scan again.
Error of_calibration(Error error) {
  if (error.code == ErrorCode::kCancelled) return stopped();
  const std::string scan = "scan again";
  const auto place = error.advice.find(scan);
  if (place != std::string::npos) error.advice.replace(place, scan.size(), "calibrate again");
  return error;
}

/// Whether the cameras are real ones. Those of both kinds stand in two frames.
Result<bool> has_real_cameras(const Settings& settings) {
  const auto real = std::count_if(settings.cameras.begin(), settings.cameras.end(),
                                  [](const auto& camera) { return camera.placement() != nullptr; });
  if (real == 0 || static_cast<std::size_t>(real) == settings.cameras.size()) return real != 0;
  return fail(ErrorCode::kInvalidInput,
              "the settings have real cameras beside simulated or recorded ones, which bring poses "
              "of their own",
              "take those out of the settings, and calibrate the real ones alone");
}

std::optional<CalibrationTarget> target_of(const std::string& out,
                                           const std::optional<fs::path>& of_station) {
  if (out.empty() && !of_station) return std::nullopt;
  if (out.empty()) return CalibrationTarget{*of_station, true};
  std::error_code no_folder;
  const bool is_same = of_station && fs::absolute(out, no_folder).lexically_normal() ==
                                         of_station->lexically_normal();
  return CalibrationTarget{out, is_same};
}

/// Before cameras are opened and seconds spent.
Result<void> check_target(Subject& subject) {
  if (!subject.target) return {};
  if (!subject.target->is_of_station) subject.use = PosesUse::kInFile;
  return check_calibration_target(*subject.target);
}

Result<Subject> look_at_station(const CalibrateCommand& command, const StopRequest& stop) {
  const auto file =
      command.config.empty() ? find_station_settings_file() : Result<fs::path>(command.config);
  if (!file) return tl::make_unexpected(file.error());
  // As the settings say: a person who moved a camera has said so there.
  auto settings = load_uncalibrated_settings(*file);
  if (!settings) return tl::make_unexpected(settings.error());
  override_paths(*settings, process_environment);  // as the daemon's, which may have the cameras
  const auto real = has_real_cameras(*settings);
  if (!real) return tl::make_unexpected(real.error());
  Subject subject;
  std::optional<fs::path> of_station;
  if (*real) of_station = calibration_beside(*file);
  subject.target = target_of(command.out, of_station);
  subject.use = *real ? PosesUse::kOfStation : PosesUse::kNeedless;
  if (auto good = check_target(subject); !good) return tl::make_unexpected(good.error());
  const auto scratch = ScratchFolder::make();
  if (!scratch) return tl::make_unexpected(scratch.error());
  const auto folder = scratch->path() / "recording";
  const auto recorded = record_station(*settings, {kFrames, std::nullopt}, folder, stop);
  if (!recorded) return tl::make_unexpected(recorded.error());
  auto capture = read_capture(folder);
  if (!capture) return tl::make_unexpected(capture.error());
  subject.capture = std::move(*capture);
  return subject;
}

Result<Subject> look_at_recording(const CalibrateCommand& command) {
  Subject subject;
  subject.target = target_of(command.out, std::nullopt);
  if (auto good = check_target(subject); !good) return tl::make_unexpected(good.error());
  auto capture = read_capture(command.recording);
  if (!capture) return tl::make_unexpected(capture.error());
  subject.capture = std::move(*capture);
  return subject;
}

double platform_height_mm(const Capture& capture) {
  return capture.platform_height_mm.value_or(0.0);
}

Result<FoundPoses> poses_of(const Capture& capture, const StopRequest& stop) {
  ProgressLine line;
  const ScanProgress progress = [&](std::string_view stage, double done) {
    line.show(stage, done);
    return !stop.is_made();
  };
  StageClock clock(progress);
  const GoOn go_on = [&clock] { return clock.go_on(); };
  clock.begin("frames", 0.0);
  auto images = camera_images(capture, go_on);
  if (!images) return tl::make_unexpected(images.error());
  clock.begin("poses", 0.3);
  PoseFinding settings;
  settings.platform_height_mm = platform_height_mm(capture);
  return find_poses(views_of(capture, std::move(*images)), settings, on_all_processors, go_on);
}

/// With what it was found from.
StationCalibration calibration_of(const CalibrationReport& report, const Capture& capture) {
  StationCalibration calibration;
  calibration.time = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  for (std::size_t i = 0; i < report.names.size(); ++i) {
    const auto& camera = capture.cameras[i];
    calibration.cameras.push_back({report.names[i], report.poses.cameras[i].station_from_camera,
                                   camera.serial, camera.geometry.station_from_camera});
  }
  calibration.platform_height_mm = platform_height_mm(capture);
  return calibration;
}

Result<CalibrationReport> calibrate(const CalibrateCommand& command, const StopRequest& stop,
                                    Result<void>& written) {
  const auto subject =
      command.recording.empty() ? look_at_station(command, stop) : look_at_recording(command);
  if (!subject) return tl::make_unexpected(subject.error());
  auto poses = poses_of(subject->capture, stop);
  if (!poses) return tl::make_unexpected(poses.error());
  if (stop.is_made()) return tl::make_unexpected(stopped());
  CalibrationReport report{{}, std::move(*poses), std::nullopt, subject->use};
  for (const auto& camera : subject->capture.cameras) report.names.push_back(camera.geometry.id);
  if (!subject->target) return report;
  written = write_calibration(*subject->target, calibration_of(report, subject->capture));
  if (written) report.file = subject->target->file;
  if (!written) report.use = PosesUse::kNotWritten;
  return report;
}

Result<void> run(const CalibrateCommand& command) {
  const StopRequest stop;  // a killed program would leave its scratch folder, and the light on
  Result<void> written;
  const auto report = calibrate(command, stop, written);
  if (!report) return tl::make_unexpected(of_calibration(report.error()));
  const bool as_text = command.format.empty() ? stdout_is_terminal() : command.format == "text";
  // Poses that could not be written are not lost.
  auto printed = as_text ? print_text(to_text(*report)) : print_json(to_json(*report));
  return written ? printed : written;
}

}  // namespace

void add_calibrate_command(CLI::App& app, int& exit_code) {
  auto* calibrate = app.add_subcommand(
      "calibrate", "Find where the cameras stand, by what they see of something on the platform");
  calibrate->footer(kHelp);
  const auto command = std::make_shared<CalibrateCommand>();
  auto* recording =
      calibrate->add_option("RECORDING", command->recording,
                            "folder of a recording; else the station's cameras are read");
  calibrate
      ->add_option("--config", command->config,
                   "settings file of the station; else that of the daemon of this machine")
      ->excludes(recording);
  calibrate
      ->add_option("--out", command->out,
                   "file to write the poses to, in place of calibration.toml")
      ->check([](const std::string& file) {
        return std::string(file.empty() ? "needs the name of a file" : "");
      });
  calibrate->add_option("--format", command->format, "json (if stdout is no terminal) or text")
      ->check(CLI::IsMember({"json", "text"}));
  calibrate->callback([command, &exit_code] { exit_code = finish_command(run(*command)); });
}

}  // namespace instep
