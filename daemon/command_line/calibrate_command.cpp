#include "daemon/command_line/calibrate_command.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "config/calibration_file.h"
#include "config/settings_file.h"
#include "daemon/command_line/calibration_report.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/station_recording.h"
#include "daemon/command_line/station_settings.h"
#include "daemon/command_line/stop_request.h"
#include "daemon/scan/camera_images.h"
#include "daemon/scan/recorded_capture.h"
#include "daemon/scan/stage_clock.h"
#include "drivers/files/file_bytes.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFrames = 30;  // a camera, of a station that is calibrated itself

constexpr const char* kHelp =
    R"(How: stand one thing as large as a foot and not round, such as a last or a shoe, alone in the
middle of the platform, stop the daemon, and run this. Every camera has to see the thing from its
side and the platform round it; four cameras round it do, two that face each other do not. The
settings have to say roughly where each stands, within some 15 cm and 25 degrees: a tape will do
(stands_at_mm and looks_at_mm in config/instep.toml). Nothing about the thing need be known.

The poses go to calibration.toml beside the settings, which have them from there. Of a RECORDING
(instep record) they are printed alone, unless --out names a file. Poses that the cameras leave
open, or contradict, are not written; what was there before stays.
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

/// A folder that is gone, with all in it, at the end of the scope.
class ScratchFolder {
 public:
  static Result<ScratchFolder> make() {
    std::error_code unknown;
    std::string path = (fs::temp_directory_path(unknown) / "instep-calibrate-XXXXXX").string();
    if (::mkdtemp(path.data()) == nullptr) {
      return tl::make_unexpected(file_error(errno, "make", path));
    }
    return ScratchFolder(path);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  fs::path path() const { return path_; }

 private:
  explicit ScratchFolder(fs::path path) : path_(std::move(path)) {}

  fs::path path_;
};

/// What is calibrated, and where its poses are to be kept.
struct Subject {
  Capture capture;
  std::optional<fs::path> file;
};

bool has_real_cameras(const Settings& settings) {
  return std::any_of(settings.cameras.begin(), settings.cameras.end(),
                     [](const auto& camera) { return camera.placement() != nullptr; });
}

Result<Subject> look_at_station(const CalibrateCommand& command) {
  const auto file =
      command.config.empty() ? find_station_settings_file() : Result<fs::path>(command.config);
  if (!file) return tl::make_unexpected(file.error());
  // As the settings say: a person who moved a camera has said so there.
  const auto settings = load_uncalibrated_settings(*file);
  if (!settings) return tl::make_unexpected(settings.error());
  const auto scratch = ScratchFolder::make();
  if (!scratch) return tl::make_unexpected(scratch.error());
  const auto folder = scratch->path() / "recording";
  const auto recorded = record_station(*settings, {kFrames, std::nullopt}, folder);
  if (!recorded) return tl::make_unexpected(recorded.error());
  auto capture = read_capture(folder);
  if (!capture) return tl::make_unexpected(capture.error());
  Subject subject{std::move(*capture), std::nullopt};
  // A simulation's cameras and a recording's bring their own poses.
  if (has_real_cameras(*settings)) subject.file = calibration_beside(*file);
  return subject;
}

Result<Subject> subject_of(const CalibrateCommand& command) {
  auto subject = Result<Subject>{};
  if (command.recording.empty()) {
    subject = look_at_station(command);
  } else {
    auto capture = read_capture(command.recording);
    if (!capture) return tl::make_unexpected(capture.error());
    subject = Subject{std::move(*capture), std::nullopt};
  }
  if (subject && !command.out.empty()) subject->file = command.out;
  return subject;
}

Result<FoundPoses> poses_of(const Capture& capture) {
  const StopRequest stop;
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
  settings.platform_height_mm = capture.platform_height_mm.value_or(0.0);
  return find_poses(views_of(capture, std::move(*images)), settings, one_thread_each, go_on);
}

Result<void> keep(const CalibrationReport& report) {
  StationCalibration calibration;
  calibration.time = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  for (std::size_t i = 0; i < report.names.size(); ++i) {
    calibration.cameras.push_back({report.names[i], report.poses.cameras[i].station_from_camera});
  }
  auto written = write_file_bytes(*report.file, calibration_toml(calibration));
  if (!written && written.error().code == ErrorCode::kPermissionDenied) {
    written.error().advice = "run it as root (sudo instep calibrate), or choose another --out";
  }
  return written;
}

Result<void> run(const CalibrateCommand& command) {
  const auto subject = subject_of(command);
  if (!subject) return tl::make_unexpected(subject.error());
  auto poses = poses_of(subject->capture);
  if (!poses) return tl::make_unexpected(poses.error());
  CalibrationReport report{{}, std::move(*poses), subject->file};
  for (const auto& camera : subject->capture.cameras) report.names.push_back(camera.geometry.id);
  if (report.file) {
    if (auto kept = keep(report); !kept) return kept;
  }
  const bool as_text = command.format.empty() ? stdout_is_terminal() : command.format == "text";
  return as_text ? print_text(to_text(report)) : print_json(to_json(report));
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
  calibrate->add_option("--out", command->out,
                        "file to write the poses to, in place of calibration.toml");
  calibrate->add_option("--format", command->format, "json (if stdout is no terminal) or text")
      ->check(CLI::IsMember({"json", "text"}));
  calibrate->callback([command, &exit_code] { exit_code = finish_command(run(*command)); });
}

}  // namespace instep
