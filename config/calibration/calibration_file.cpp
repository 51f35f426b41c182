#include "config/calibration/calibration_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <system_error>
#include <utility>

#include "config/poses/pose_matrix.h"
#include "config/reading/settings_table.h"
#include "config/reading/toml_reading.h"
#include "core/fusion/frames/camera_limits.h"

namespace instep {
namespace {

constexpr const char* kHead =
    R"(# Where the cameras of the station stand, written by `instep calibrate`. instepd reads it beside
# its settings and takes these poses for theirs; delete it to go back to the settings' own.
# Beside them stands what they were found from: the units by their serial numbers, the poses of the
# settings (began_from), the height of the platform. Where the station is another by now, instepd,
# its results and instep doctor say so, and it is time to run `instep calibrate` again.
)";
constexpr int kVersion = 2;

std::string quoted(const std::string& text) {
  std::ostringstream out;
  out << toml::toml_formatter{toml::value<std::string>(text), toml::format_flags::none};
  return out.str();
}

/// The fewest digits that read back as the same number.
std::string exact(double number) {
  const std::string text = fmt::format("{}", number);
  return text == "-0" ? "-0.0" : text;  // a whole number has no negative zero
}

std::string pose_text(const char* key, const RigidTransform& pose) {
  std::string text = fmt::format("{} = [\n", key);
  const Eigen::Matrix4d& matrix = pose.matrix();
  for (int row = 0; row < 4; ++row) {
    text += fmt::format("  {}, {}, {}, {},\n", exact(matrix(row, 0)), exact(matrix(row, 1)),
                        exact(matrix(row, 2)), exact(matrix(row, 3)));
  }
  return text + "]\n";
}

/// The version whose keys it can fill.
int version_of(const StationCalibration& calibration) {
  const bool tells_its_origin =
      calibration.platform_height_mm &&
      std::all_of(calibration.cameras.begin(), calibration.cameras.end(),
                  [](const auto& camera) { return camera.began_from.has_value(); });
  return tells_its_origin ? kVersion : 1;
}

std::string head_of(const StationCalibration& calibration, int version) {
  std::string text = kHead;
  if (version == kVersion) text += fmt::format("version = {}\n", kVersion);
  text += fmt::format("calibrated_at = {}\n", quoted(calibration.time));
  if (version != kVersion) return text;
  return text + fmt::format("platform_height_mm = {}\n", exact(*calibration.platform_height_mm));
}

std::string camera_table(const CalibratedCamera& camera, int version) {
  const bool has_serial = version == kVersion && !camera.serial.empty();
  std::string text = fmt::format("\n[[camera]]\nname = {}\n", quoted(camera.name));
  if (has_serial) text += fmt::format("serial = {}\n", quoted(camera.serial));
  text += pose_text("station_from_camera", camera.station_from_camera);
  return version == kVersion ? text + pose_text("began_from", *camera.began_from) : text;
}

/// Nothing if it is one that is not known.
std::optional<int> read_version(SettingsTable& root, SettingsFaults& faults) {
  int version = 1;
  const auto faults_before = faults.count();
  root.read("version", version, std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
  if (faults.count() != faults_before) return std::nullopt;
  if (version == 1 || version == kVersion) return version;
  faults.add(
      root.line("version"),
      fmt::format("version = {} is none of 1 to {}: it is of another program", version, kVersion));
  return std::nullopt;
}

bool is_utc_time(const std::string& text) {
  constexpr std::string_view kForm = "0000-00-00T00:00:00Z";
  const bool has_form =
      std::equal(text.begin(), text.end(), kForm.begin(), kForm.end(), [](char letter, char form) {
        return form == '0' ? letter >= '0' && letter <= '9' : letter == form;
      });
  if (!has_form) return false;
  const auto within = [&](std::size_t place, int least, int most) {
    const int number = 10 * (text[place] - '0') + (text[place + 1] - '0');
    return number >= least && number <= most;
  };
  // A second of 60 is a leap second.
  return within(5, 1, 12) && within(8, 1, 31) && within(11, 0, 23) && within(14, 0, 59) &&
         within(17, 0, 60);
}

std::string read_time(SettingsTable& root, SettingsFaults& faults) {
  constexpr const char* kKey = "calibrated_at";
  constexpr std::size_t kLongest = 64;
  std::string time;
  root.read(kKey, time, kLongest);
  const bool is_faulty = root.has(kKey) && time.empty();  // which has been said
  if (!is_faulty && !is_utc_time(time)) {
    faults.add(root.line(kKey),
               fmt::format("{} must be a time such as \"2026-11-28T02:11:12Z\"", kKey));
  }
  return time;
}

void require(const SettingsTable& table, const char* key, SettingsFaults& faults) {
  if (!table.has(key)) faults.add(table.line(), table.full(key) + " is missing");
}

CalibratedCamera read_camera(SettingsTable& table, int version, SettingsFaults& faults) {
  constexpr std::size_t kLongestName = 64;
  constexpr std::size_t kLongestSerial = 64;
  CalibratedCamera camera;
  table.read("name", camera.name, kLongestName);
  if (const auto pose = read_pose_matrix(table, faults)) camera.station_from_camera = *pose;
  for (const char* key : {"name", "station_from_camera"}) require(table, key, faults);
  if (version == kVersion) {
    table.read("serial", camera.serial, kLongestSerial);
    camera.began_from = read_pose_matrix(table, faults, "began_from");
    require(table, "began_from", faults);
  }
  table.finish();
  return camera;
}

std::vector<CalibratedCamera> read_cameras(SettingsTable& root, int version,
                                           SettingsFaults& faults) {
  std::vector<CalibratedCamera> cameras;
  for (const toml::table* camera : root.tables("camera")) {
    SettingsTable table(*camera, "camera", faults);
    CalibratedCamera read = read_camera(table, version, faults);
    const bool is_twice = std::any_of(cameras.begin(), cameras.end(), [&](const auto& before) {
      return !read.name.empty() && before.name == read.name;
    });
    if (is_twice) faults.add(table.line(), "there are two cameras of the name " + read.name);
    cameras.push_back(std::move(read));
  }
  if (!root.has("camera")) faults.add(1, "there is no [[camera]]");
  if (cameras.size() > kMostCalibratedCameras) {
    faults.add(1, fmt::format("there are {} [[camera]] tables, more than {}", cameras.size(),
                              kMostCalibratedCameras));
  }
  return cameras;
}

StationCalibration read_root(const toml::table& toml, SettingsFaults& faults) {
  StationCalibration calibration;
  SettingsTable root(toml, "", faults);
  const auto version = read_version(root, faults);
  if (!version) return calibration;  // nobody knows what else it may say
  calibration.time = read_time(root, faults);
  calibration.cameras = read_cameras(root, *version, faults);
  if (*version == kVersion) {
    root.read("platform_height_mm", calibration.platform_height_mm, -kFarthestCameraMm,
              kFarthestCameraMm);
    require(root, "platform_height_mm", faults);
  }
  root.finish();
  return calibration;
}

}  // namespace

std::filesystem::path calibration_beside(const std::filesystem::path& settings_file) {
  std::error_code no_folder;  // the one that the program runs in may be gone
  const auto absolute = std::filesystem::absolute(settings_file, no_folder);
  return (no_folder ? settings_file : absolute).parent_path() / kCalibrationFileName;
}

std::string calibration_toml(const StationCalibration& calibration) {
  const int version = version_of(calibration);
  std::string text = head_of(calibration, version);
  for (const auto& camera : calibration.cameras) text += camera_table(camera, version);
  return text;
}

Result<StationCalibration> read_calibration(std::string_view toml,
                                            const std::filesystem::path& file) {
  SettingsFaults faults(file.string());
  StationCalibration calibration;
  read_toml(toml, file, faults,
            [&](const toml::table& root) { calibration = read_root(root, faults); });
  if (faults.count() == 0) return calibration;
  return fail(ErrorCode::kInvalidInput, fmt::format("{}", fmt::join(faults.in_order(), "\n")),
              "mend it, or delete it and run instep calibrate again");
}

}  // namespace instep
