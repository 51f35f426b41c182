#include "daemon/command_line/doctor/doctor_checks.h"

#include <fmt/format.h>
#include <sys/statvfs.h>
#include <Eigen/Core>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/built_for.h"
#include "daemon/build_facts.h"
#include "daemon/command_line/doctor/closed_check.h"
#include "daemon/command_line/doctor/daemon_checks.h"
#include "daemon/command_line/doctor/output_look.h"
#include "daemon/command_line/doctor/pedal_check.h"
#include "daemon/command_line/doctor/store_check.h"
#include "daemon/command_line/station_settings.h"
#include "daemon/control/control_client.h"
#include "daemon/json/untrusted_json.h"
#include "daemon/machine/device_checks.h"
#include "daemon/station/devices.h"

namespace instep {
namespace {

using nlohmann::json;

constexpr const char* kCalibrate = "instep calibrate";

/// The daemon, as it answers or does not.
struct AskedDaemon {
  Result<json> status;
  std::optional<uid_t> user{};  ///< whom it runs as, if it answers

  /// Nobody listens, and the devices may be opened.
  bool is_away() const {
    return !status && (status.error().code == ErrorCode::kNotFound ||
                       status.error().code == ErrorCode::kInvalidInput);
  }
};

AskedDaemon ask_daemon(const std::filesystem::path& socket) {
  auto client = ControlClient::connect(socket);
  if (!client) return {tl::make_unexpected(client.error())};
  auto status = client->ask("status");
  const auto user = status ? client->daemon_user() : std::nullopt;
  return {std::move(status), user};
}

DoctorCheck check_settings(const Result<FoundSettings>& found) {
  if (found) return good_check("settings", found->file.string() + " is sound");
  std::string finding = found.error().line();
  for (auto& letter : finding) letter = letter == '\n' ? ';' : letter;
  return bad_check("settings", finding, "correct the file, then: instepd --check");
}

/// Nothing where there is no folder yet, of which check_store() tells.
std::optional<DoctorCheck> check_free_space(const std::filesystem::path& root) {
  constexpr double kGibibyte = 1024.0 * 1024.0 * 1024.0;
  struct statvfs disk {};
  const auto folder = root.parent_path();
  if (::statvfs(root.c_str(), &disk) != 0 && ::statvfs(folder.c_str(), &disk) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) return std::nullopt;
    return bad_check("disk", folder.string() + " cannot be looked at: " + std::strerror(errno),
                     "check store.root");
  }
  const double free_gib =
      static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize) / kGibibyte;
  const std::string finding = fmt::format("{:.1f} GiB free for results", free_gib);
  return free_gib >= 1.0 ? good_check("disk", finding)
                         : bad_check("disk", finding, "make room, or set store.keep_days");
}

ToldSerials told_serials(const json& cameras) {
  ToldSerials told;
  for (const auto& camera : cameras) told[string_at(camera, "id")] = string_at(camera, "serial");
  return told;
}

VideoTroubles troubles_of_video_cameras(const Settings& settings) {
  VideoTroubles all;
  for (const auto& camera : settings.cameras) {
    if (camera.kind != CameraKind::kV4l2) continue;
    all[camera.v4l2.placement.name] = trouble_of_camera(camera.v4l2, {});
  }
  return all;
}

/// Nothing of video cameras, which are among the devices though they be away.
std::vector<DoctorCheck> check_opening(const OpenedDevices& devices, const VideoTroubles& video) {
  std::vector<DoctorCheck> checks;
  if (!devices) {
    for (const auto& source : devices.error().sources) {
      checks.push_back(failed_check("cameras", source.error));
      if (checks.back().remedy.empty()) checks.back().remedy = "instepd --check";
    }
  } else if (devices->cameras.empty()) {
    checks.push_back(no_cameras());
  }
  const auto opened = devices ? devices->cameras.size() : devices.error().without_fault.size();
  if (opened > video.size()) {
    checks.push_back(good_check("cameras", fmt::format("{} can be opened", opened - video.size())));
  }
  return checks;
}

ToldSerials told_serials(const OpenedDevices& devices) {
  ToldSerials told;
  if (!devices) return told;
  for (const auto& camera : devices->cameras) {
    told[camera->description().geometry.id] = camera->description().serial;
  }
  return told;
}

void add(std::vector<DoctorCheck> more, std::vector<DoctorCheck>& checks) {
  std::move(more.begin(), more.end(), std::back_inserter(checks));
}

/// As the daemon tells, who has the cameras, or opens them if there is none and the settings are
/// sound. Gives what they tell.
ToldSerials look_at_cameras(const AskedDaemon& daemon, const Settings& settings, bool are_sound,
                            std::vector<DoctorCheck>& checks) {
  auto video = troubles_of_video_cameras(settings);
  ToldSerials told;
  if (daemon.status) {
    video = without_those_of(*daemon.status, std::move(video));
    add(check_cameras_of(*daemon.status, video), checks);
    told = told_serials(list_at(*daemon.status, "cameras"));
  } else if (daemon.is_away() && are_sound) {
    const auto devices = open_devices_at_last()(settings);
    add(check_opening(devices, video), checks);
    told = told_serials(devices);
  }
  add(check_video_cameras(video, daemon.user), checks);
  return told;
}

void check_usb_memory(std::vector<DoctorCheck>& checks) {
  if (const auto trouble = trouble_of_usb_memory({})) {
    checks.push_back(bad_check("usb", trouble->finding, trouble->remedy));
  }
}

/// As the daemon tells, who has the pedal, or opens one that is a device.
void look_at_pedal(const AskedDaemon& daemon, const Settings& settings,
                   std::vector<DoctorCheck>& checks) {
  if (daemon.status) {
    if (auto check = check_pedal_of(*daemon.status)) checks.push_back(std::move(*check));
    return;
  }
  const auto kind = settings.pedal.kind;
  if (!daemon.is_away() || (kind != PedalKind::kGpio && kind != PedalKind::kEvdev)) return;
  checks.push_back(check_pedal(settings.pedal, [settings] { return open_pedal(settings); }));
}

/// As the daemon tells, who has the lines, or looks whether they could be had. Touches none.
std::vector<DoctorCheck> look_at_outputs(const AskedDaemon& daemon, const Settings& settings) {
  if (daemon.status) return check_outputs(outputs_of(*daemon.status), "is there");
  if (!daemon.is_away()) return {};
  return check_outputs(look_for_outputs(settings.outputs, check_output), "can be opened");
}

/// Of real cameras that no calibration placed; a single one that stands as the settings say has
/// none to fit with.
std::optional<DoctorCheck> check_uncalibrated(const std::vector<CameraPlacement>& cameras) {
  std::vector<std::string> rough;
  for (const auto& camera : cameras) {
    if (camera.is_rough) rough.push_back(camera.name);
  }
  if (!rough.empty()) {
    return bad_check(
        "calibration",
        fmt::format("none, and placed by tape measure alone: {}", fmt::join(rough, ", ")),
        kCalibrate);
  }
  if (cameras.size() < 2) return std::nullopt;
  return good_check("calibration",
                    fmt::format("none: {} cameras stand as the settings say; {} finds "
                                "out where they do",
                                cameras.size(), kCalibrate));
}

DoctorCheck library_versions() {
  return good_check(
      "software",
      fmt::format("instep {} for {}, fmt {}.{}.{}, nlohmann-json {}.{}.{}, Eigen {}.{}.{}",
                  program_version(), built_for(), FMT_VERSION / 10000, FMT_VERSION / 100 % 100,
                  FMT_VERSION % 100, NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                  NLOHMANN_JSON_VERSION_PATCH, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
                  EIGEN_MINOR_VERSION));
}

void look_at_daemon(const AskedDaemon& daemon, const std::filesystem::path& socket,
                    std::vector<DoctorCheck>& checks) {
  checks.push_back(check_daemon(daemon.status, socket));
  if (daemon.status || daemon.is_away()) return;
  checks.push_back(unseen_check("devices", "not looked at: the daemon has them and cannot be asked",
                                checks.back().remedy));
}

}  // namespace

std::optional<DoctorCheck> check_calibration(const Settings& settings, const ToldSerials& told) {
  std::vector<CameraPlacement> cameras;
  for (const auto& camera : settings.cameras) {
    if (camera.placement() != nullptr) cameras.push_back(*camera.placement());
  }
  if (!settings.calibration) return check_uncalibrated(cameras);
  if (cameras.empty()) return std::nullopt;
  const std::string lacking = what_is_lacking(*settings.calibration);
  if (!lacking.empty()) return bad_check("calibration", lacking, kCalibrate);
  const auto changes = what_has_changed(settings, told);
  if (!changes.empty()) {
    return bad_check("calibration",
                     fmt::format("of another station than this: {}", fmt::join(changes, "; ")),
                     kCalibrate);
  }
  return good_check("calibration", fmt::format("of all {} cameras, {}", cameras.size(),
                                               settings.calibration->time));
}

std::vector<DoctorCheck> examine_machine() {
  const auto found = find_station_settings();
  const Settings settings = found ? found->settings : station_settings();
  const auto daemon = ask_daemon(settings.control.socket);
  std::vector<DoctorCheck> checks;
  checks.push_back(library_versions());
  checks.push_back(check_settings(found));
  const auto store = std::filesystem::absolute(settings.store.root);
  checks.push_back(daemon.status ? check_store_of(*daemon.status, store, daemon.user)
                                 : check_store(store, std::nullopt));
  if (auto space = check_free_space(store)) checks.push_back(std::move(*space));
  look_at_daemon(daemon, settings.control.socket, checks);
  const auto told = look_at_cameras(daemon, settings, found.has_value(), checks);
  // Of a faulty calibration check_settings() tells.
  auto calibration = found ? check_calibration(settings, told) : std::nullopt;
  if (calibration) checks.push_back(std::move(*calibration));
  check_usb_memory(checks);
  look_at_pedal(daemon, settings, checks);
  add(look_at_outputs(daemon, settings), checks);
  return checks;
}

}  // namespace instep
