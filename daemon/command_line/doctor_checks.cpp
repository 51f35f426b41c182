#include "daemon/command_line/doctor_checks.h"

#include <fmt/format.h>
#include <pwd.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <Eigen/Core>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "core/built_for.h"
#include "daemon/build_facts.h"
#include "daemon/command_line/station_settings.h"
#include "daemon/control/control_client.h"
#include "daemon/json/untrusted_json.h"
#include "daemon/machine/device_checks.h"
#include "daemon/machine/folder_rights.h"
#include "daemon/station/devices.h"
#include "drivers/files/file_bytes.h"

namespace instep {
namespace {

using nlohmann::json;

constexpr const char* kCalibrate = "instep calibrate";

DoctorCheck good(const char* name, std::string finding) {
  return {name, true, std::move(finding), ""};
}

DoctorCheck bad(const char* name, std::string finding, std::string remedy) {
  return {name, false, std::move(finding), std::move(remedy)};
}

DoctorCheck check_settings(const Result<FoundSettings>& found) {
  if (found) return good("settings", found->file.string() + " is sound");
  std::string finding = found.error().line();
  for (auto& letter : finding) letter = letter == '\n' ? ';' : letter;
  return bad("settings", finding, "correct the file, then: instepd --check");
}

/// Whom the daemon would run as: where Instep is installed, not as root.
std::optional<uid_t> installed_user() {
  const auto* user = ::getpwnam("instep");
  return user != nullptr ? std::optional(user->pw_uid) : std::nullopt;
}

/// For no daemon runs: may it, or whoever runs it, write there?
bool may_owner_write(const std::filesystem::path& folder) {
  struct stat there {};
  if (::stat(folder.c_str(), &there) != 0) return false;
  const auto user = installed_user();
  const bool is_daemons = user ? there.st_uid == *user : there.st_uid != 0;
  return is_daemons && (there.st_mode & S_IWUSR) != 0 && (there.st_mode & S_IXUSR) != 0;
}

/// Whoever asks needs no right to write: it is the daemon that keeps the results.
DoctorCheck check_writing(const std::filesystem::path& folder, std::optional<uid_t> daemon) {
  struct statvfs disk {};
  if (::statvfs(folder.c_str(), &disk) == 0 && (disk.f_flag & ST_RDONLY) != 0) {
    return bad("store", folder.string() + " is read-only", kReadOnlyAdvice);
  }
  if (daemon) {
    if (may_write_in(folder, *daemon)) {
      return good("store", folder.string() + ", kept by the daemon");
    }
    return bad(
        "store",
        "the daemon, of the user " + user_name(*daemon) + ", may not write in " + folder.string(),
        advice_to_give(folder, *daemon));
  }
  if (::access(folder.c_str(), W_OK | X_OK) == 0) {
    return good("store", folder.string() + ", writable");
  }
  const std::string trouble = std::strerror(errno);
  if (may_owner_write(folder)) return good("store", folder.string() + ", writable for its owner");
  const auto user = installed_user();
  return bad("store", "the daemon may not write in " + folder.string() + ": " + trouble,
             user ? advice_to_give(folder, *user) : "set store.root to a folder of your own");
}

/// Nothing where there is no folder yet, of which check_store() tells.
std::optional<DoctorCheck> check_free_space(const std::filesystem::path& root) {
  constexpr double kGibibyte = 1024.0 * 1024.0 * 1024.0;
  struct statvfs disk {};
  const auto folder = root.parent_path();
  if (::statvfs(root.c_str(), &disk) != 0 && ::statvfs(folder.c_str(), &disk) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) return std::nullopt;
    return bad("disk", folder.string() + " cannot be looked at: " + std::strerror(errno),
               "check store.root");
  }
  const double free_gib =
      static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize) / kGibibyte;
  const std::string finding = fmt::format("{:.1f} GiB free for results", free_gib);
  return free_gib >= 1.0 ? good("disk", finding)
                         : bad("disk", finding, "make room, or set store.keep_days");
}

bool has_cameras(const Result<json>& status) {
  return status && status->contains("cameras") && (*status)["cameras"].is_array();
}

DoctorCheck no_cameras() {
  return bad("cameras", "none is open", "plug them in, then see which are found: instep devices");
}

DoctorCheck check_cameras(const json& cameras) {
  if (cameras.empty()) return no_cameras();
  for (const auto& camera : cameras) {
    if (!camera.value("ok", false)) {
      return bad("cameras", string_at(camera, "trouble"), "plug it in again, then: instep status");
    }
  }
  return good("cameras", fmt::format("all {} answer", cameras.size()));
}

ToldSerials told_serials(const json& cameras) {
  ToldSerials told;
  for (const auto& camera : cameras) told[string_at(camera, "id")] = string_at(camera, "serial");
  return told;
}

DoctorCheck check_cameras(const Result<Devices>& devices) {
  if (!devices) {
    return bad("cameras", devices.error().message,
               devices.error().advice.empty() ? "instepd --check" : devices.error().advice);
  }
  if (devices->cameras.empty()) return no_cameras();
  return good("cameras", fmt::format("{} can be opened", devices->cameras.size()));
}

ToldSerials told_serials(const Result<Devices>& devices) {
  ToldSerials told;
  if (!devices) return told;
  for (const auto& camera : devices->cameras) {
    told[camera->description().geometry.id] = camera->description().serial;
  }
  return told;
}

/// Asks the daemon, who has the cameras, or opens them if there is none. Gives what they tell.
ToldSerials look_at_cameras(const Result<json>& status, const Settings& settings,
                            std::vector<DoctorCheck>& checks) {
  if (has_cameras(status)) {
    checks.push_back(check_cameras((*status)["cameras"]));
    return told_serials((*status)["cameras"]);
  }
  const auto devices = open_devices(settings);
  checks.push_back(check_cameras(devices));
  return told_serials(devices);
}

/// What a camera that does not answer lacks, as the kernel's folders show it.
void check_video_cameras(const Settings& settings, std::vector<DoctorCheck>& checks) {
  for (const auto& camera : settings.cameras) {
    if (camera.kind != CameraKind::kV4l2) continue;
    const auto trouble = trouble_of_camera(camera.v4l2, {});
    const std::string& name = camera.v4l2.placement.name;
    checks.push_back(trouble ? bad("camera", name + ": " + trouble->finding, trouble->remedy)
                             : good("camera", name + " is plugged in and may be opened"));
  }
}

void check_usb_memory(std::vector<DoctorCheck>& checks) {
  if (const auto trouble = trouble_of_usb_memory({})) {
    checks.push_back(bad("usb", trouble->finding, trouble->remedy));
  }
}

/// Asks the daemon, who has the pedal, or opens one that is a device.
void check_pedal(const Result<json>& status, const Settings& settings,
                 std::vector<DoctorCheck>& checks) {
  if (status) {
    if (auto check = check_pedal_of(*status)) checks.push_back(std::move(*check));
    return;
  }
  const auto kind = settings.pedal.kind;
  if (kind != PedalKind::kGpio && kind != PedalKind::kEvdev) return;
  const auto pedal = open_pedal(settings);
  checks.push_back(pedal ? good("pedal", "can be opened")
                         : bad("pedal", pedal.error().message, pedal.error().advice));
}

/// Asks the daemon, who has the lines, or looks whether they could be had. Touches none.
void check_outputs(const Result<json>& status, const Settings& settings,
                   std::vector<DoctorCheck>& checks) {
  if (status) {
    for (const auto& output : status->value("outputs", json::array())) {
      const std::string name = string_at(output, "name");
      const std::string trouble = string_at(output, "trouble");
      checks.push_back(trouble.empty() ? good("output", name + " is there")
                                       : bad("output", name + ": " + trouble, "instep devices"));
    }
    return;
  }
  for (const auto& [name, output] : settings.outputs.named()) {
    const auto there = check_output(*output);
    checks.push_back(
        there ? good("output", std::string(name) + " can be opened")
              : bad("output", name + (": " + there.error().message), there.error().advice));
  }
}

/// Of real cameras that no calibration placed; a single one that stands as the settings say has
/// none to fit with.
std::optional<DoctorCheck> check_uncalibrated(const std::vector<CameraPlacement>& cameras) {
  std::vector<std::string> rough;
  for (const auto& camera : cameras) {
    if (camera.is_rough) rough.push_back(camera.name);
  }
  if (!rough.empty()) {
    return bad("calibration",
               fmt::format("none, and placed by tape measure alone: {}", fmt::join(rough, ", ")),
               kCalibrate);
  }
  if (cameras.size() < 2) return std::nullopt;
  return good("calibration", fmt::format("none: {} cameras stand as the settings say; {} finds "
                                         "out where they do",
                                         cameras.size(), kCalibrate));
}

DoctorCheck library_versions() {
  return good("software",
              fmt::format("instep {} for {}, fmt {}.{}.{}, nlohmann-json {}.{}.{}, Eigen {}.{}.{}",
                          program_version(), built_for(), FMT_VERSION / 10000,
                          FMT_VERSION / 100 % 100, FMT_VERSION % 100, NLOHMANN_JSON_VERSION_MAJOR,
                          NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH,
                          EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
}

/// Notes as whom the daemon that answers runs.
Result<json> ask_status(const std::filesystem::path& socket, std::optional<uid_t>& daemon) {
  auto client = ControlClient::connect(socket);
  if (!client) return tl::make_unexpected(client.error());
  auto status = client->ask("status");
  if (status) daemon = client->daemon_user();
  return status;
}

}  // namespace

DoctorCheck check_daemon(const Result<json>& status, const std::filesystem::path& socket) {
  if (!status) {
    const bool hangs = status.error().code == ErrorCode::kTimeout;
    return bad("daemon", status.error().message,
               hangs ? "sudo systemctl restart instepd" : status.error().advice);
  }
  const auto trouble = string_at(*status, "trouble");
  if (!trouble.empty())
    return bad("daemon", string_at(*status, "state") + ": " + trouble, "instep status");
  return good("daemon", string_at(*status, "state") + ", answers on " + socket.string());
}

DoctorCheck check_store_of(const json& status, const std::filesystem::path& root,
                           std::optional<uid_t> daemon) {
  const json store = status.value("store", json());
  const std::string its_root = string_at(store, "root");
  if (!its_root.empty() &&
      std::filesystem::path(its_root).lexically_normal() != root.lexically_normal()) {
    return bad("store",
               "the daemon keeps results in " + its_root +
                   ", and the settings that the doctor sees say " + root.string(),
               "if the settings were changed since it began: sudo systemctl restart instepd; else "
               "give INSTEP_STORE and INSTEP_CONFIG to both alike, or to neither");
  }
  const std::string trouble = string_at(store, "trouble");
  if (!trouble.empty()) return bad("store", trouble, "mend that, then: instep status");
  return check_store(root, daemon);
}

std::optional<DoctorCheck> check_pedal_of(const json& status) {
  const json pedal = status.value("pedal", json());
  if (!pedal.is_object()) return std::nullopt;
  const std::string trouble = string_at(pedal, "trouble");
  return trouble.empty() ? good("pedal", "is there")
                         : bad("pedal", trouble, "mend that, then: instep status");
}

DoctorCheck check_store(const std::filesystem::path& root, std::optional<uid_t> daemon) {
  std::error_code failed;
  const bool there = std::filesystem::exists(root, failed);
  const auto folder = there ? root : root.parent_path();
  if (there && !std::filesystem::is_directory(root, failed)) {
    return bad("store", root.string() + " is no folder", "set store.root to a folder");
  }
  if (!std::filesystem::is_directory(folder, failed)) {
    return bad("store", folder.string() + " is not there",
               installed_user()
                   ? "sudo install -d -o instep -g instep -m 0750 " + folder.string()
                   : "install Instep (README.md), or set store.root to a folder of your own");
  }
  auto check = check_writing(folder, daemon);
  if (check.good && !there) check.finding = "will be made in " + check.finding;
  return check;
}

std::optional<DoctorCheck> check_calibration(const Settings& settings, const ToldSerials& told) {
  std::vector<CameraPlacement> cameras;
  for (const auto& camera : settings.cameras) {
    if (camera.placement() != nullptr) cameras.push_back(*camera.placement());
  }
  if (!settings.calibration) return check_uncalibrated(cameras);
  if (cameras.empty()) return std::nullopt;
  const std::string lacking = what_is_lacking(*settings.calibration);
  if (!lacking.empty()) return bad("calibration", lacking, kCalibrate);
  const auto changes = what_has_changed(settings, told);
  if (!changes.empty()) {
    return bad("calibration",
               fmt::format("of another station than this: {}", fmt::join(changes, "; ")),
               kCalibrate);
  }
  return good("calibration",
              fmt::format("of all {} cameras, {}", cameras.size(), settings.calibration->time));
}

std::vector<DoctorCheck> examine_machine() {
  const auto found = find_station_settings();
  const Settings settings = found ? found->settings : station_settings();
  std::optional<uid_t> daemon;
  const auto status = ask_status(settings.control.socket, daemon);
  std::vector<DoctorCheck> checks;
  checks.push_back(library_versions());
  checks.push_back(check_settings(found));
  const auto store = std::filesystem::absolute(settings.store.root);
  checks.push_back(status ? check_store_of(*status, store, daemon) : check_store(store, daemon));
  if (auto space = check_free_space(store)) checks.push_back(std::move(*space));
  checks.push_back(check_daemon(status, settings.control.socket));
  ToldSerials told;
  if (found) told = look_at_cameras(status, settings, checks);
  check_video_cameras(settings, checks);
  // Of a faulty calibration check_settings() tells.
  auto calibration = found ? check_calibration(settings, told) : std::nullopt;
  if (calibration) checks.push_back(std::move(*calibration));
  check_usb_memory(checks);
  check_pedal(status, settings, checks);
  check_outputs(status, settings, checks);
  return checks;
}

}  // namespace instep
