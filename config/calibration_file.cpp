#include "config/calibration_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <system_error>
#include <utility>

#include "config/pose_matrix.h"
#include "config/settings_table.h"

namespace instep {
namespace {

constexpr const char* kHead =
    "# Where the cameras of the station stand, written by `instep calibrate`. instepd reads it "
    "beside\n"
    "# its settings and takes these poses for theirs; delete it to go back to the settings' own.\n";

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

std::string camera_table(const CalibratedCamera& camera) {
  std::string text =
      fmt::format("\n[[camera]]\nname = {}\nstation_from_camera = [\n", quoted(camera.name));
  const Eigen::Matrix4d& matrix = camera.station_from_camera.matrix();
  for (int row = 0; row < 4; ++row) {
    text += fmt::format("  {}, {}, {}, {},\n", exact(matrix(row, 0)), exact(matrix(row, 1)),
                        exact(matrix(row, 2)), exact(matrix(row, 3)));
  }
  return text + "]\n";
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

CalibratedCamera read_camera(SettingsTable& table, SettingsFaults& faults) {
  constexpr std::size_t kLongestName = 64;
  CalibratedCamera camera;
  table.read("name", camera.name, kLongestName);
  if (const auto pose = read_pose_matrix(table, faults)) camera.station_from_camera = *pose;
  for (const char* key : {"name", "station_from_camera"}) {
    if (!table.has(key)) faults.add(table.line(), table.full(key) + " is missing");
  }
  table.finish();
  return camera;
}

std::vector<CalibratedCamera> read_cameras(SettingsTable& root, SettingsFaults& faults) {
  std::vector<CalibratedCamera> cameras;
  for (const toml::table* camera : root.tables("camera")) {
    SettingsTable table(*camera, "camera", faults);
    CalibratedCamera read = read_camera(table, faults);
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

StationCalibration read_all(std::string_view text, const std::string& file,
                            SettingsFaults& faults) {
  StationCalibration calibration;
  try {
    const toml::table toml = toml::parse(text, file);
    SettingsTable root(toml, "", faults);
    calibration.time = read_time(root, faults);
    calibration.cameras = read_cameras(root, faults);
    root.finish();
  } catch (const toml::parse_error& error) {
    faults.add(error.source().begin.line, std::string(error.description()));
  }
  return calibration;
}

}  // namespace

std::filesystem::path calibration_beside(const std::filesystem::path& settings_file) {
  std::error_code no_folder;  // the one that the program runs in may be gone
  const auto absolute = std::filesystem::absolute(settings_file, no_folder);
  return (no_folder ? settings_file : absolute).parent_path() / kCalibrationFileName;
}

std::string calibration_toml(const StationCalibration& calibration) {
  std::string text = kHead + fmt::format("calibrated_at = {}\n", quoted(calibration.time));
  for (const auto& camera : calibration.cameras) text += camera_table(camera);
  return text;
}

Result<StationCalibration> read_calibration(std::string_view toml,
                                            const std::filesystem::path& file) {
  SettingsFaults faults(file.string());
  StationCalibration calibration = read_all(toml, file.string(), faults);
  if (faults.count() == 0) return calibration;
  return fail(ErrorCode::kInvalidInput, fmt::format("{}", fmt::join(faults.in_order(), "\n")),
              "mend it, or delete it and run instep calibrate again");
}

}  // namespace instep
