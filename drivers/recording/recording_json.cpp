#include "drivers/recording/recording_json.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/fusion/frames/camera_limits.h"
#include "core/geometry/pose_rows.h"
#include "drivers/recording/json_fields.h"

namespace instep {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "instep-recording";
constexpr int kVersion = 1;
constexpr const char* kAdvice = "correct the file or record again";

json camera_to_json(const CameraDescription& camera) {
  const auto& lens = camera.geometry.intrinsics;
  json object = {{"id", camera.geometry.id},
                 {"model", camera.model},
                 {"width", lens.width},
                 {"height", lens.height},
                 {"depth_unit_mm", camera.depth_unit_mm},
                 {"fx", lens.fx},
                 {"fy", lens.fy},
                 {"cx", lens.cx},
                 {"cy", lens.cy},
                 {"distortion", lens.distortion},
                 {"station_from_camera", pose_rows(camera.geometry.station_from_camera)}};
  if (!camera.serial.empty()) object["serial"] = camera.serial;
  return object;
}

/// A name that is safe to show and to write: some printable characters.
bool is_plain_name(const std::string& name) {
  return !name.empty() && name.size() <= 128 && std::all_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
  });
}

RigidTransform take_pose(JsonFields& fields) {
  const Eigen::Matrix4d matrix = matrix_from_rows(fields.numbers("station_from_camera", 16));
  if (fields.first_fault()) return RigidTransform::Identity();
  if (const auto fault = fault_of_pose(matrix)) fields.fault("station_from_camera", *fault);
  return fields.first_fault() ? RigidTransform::Identity() : nearest_rigid(matrix);
}

Result<CameraDescription> camera_from_json(const json& object, const std::string& where) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  JsonFields fields(object, where);
  CameraDescription camera;
  auto& lens = camera.geometry.intrinsics;
  camera.geometry.id = fields.text("id");
  camera.model = fields.text("model");
  if (fields.has("serial")) camera.serial = fields.text("serial");
  lens.width = static_cast<int>(fields.integer("width", kSmallestImageSide, kLargestImageSide));
  lens.height = static_cast<int>(fields.integer("height", kSmallestImageSide, kLargestImageSide));
  camera.depth_unit_mm = fields.number("depth_unit_mm", kSmallestDepthUnitMm, kLargestDepthUnitMm);
  lens.fx = fields.number("fx", -kLargest, kLargest);
  lens.fy = fields.number("fy", -kLargest, kLargest);
  lens.cx = fields.number("cx", -kLargest, kLargest);
  lens.cy = fields.number("cy", -kLargest, kLargest);
  if (fields.has("distortion")) {
    const auto numbers = fields.numbers("distortion", lens.distortion.size());
    std::copy(numbers.begin(), numbers.end(), lens.distortion.begin());
  }
  camera.geometry.station_from_camera = take_pose(fields);
  if (!is_plain_name(camera.geometry.id))
    fields.fault("id", "must be 1 to 128 printable characters");
  if (fields.first_fault()) return fail(ErrorCode::kCorruptData, *fields.first_fault(), kAdvice);
  if (const auto good = check_intrinsics(lens); !good) {
    return fail(good.error().code, where + ": " + good.error().message, kAdvice);
  }
  return camera;
}

/// True for a relative name that does not climb out of its folder.
bool stays_inside(const std::filesystem::path& file) {
  return !file.empty() && file.is_relative() && file.native().find('\0') == std::string::npos &&
         std::none_of(file.begin(), file.end(), [](const auto& part) { return part == ".."; });
}

Result<RecordedFrame> frame_from_json(const json& object, const std::string& where) {
  JsonFields fields(object, where);
  RecordedFrame frame;
  frame.camera = fields.text("camera");
  frame.file = fields.text("file");
  frame.time = std::chrono::microseconds(fields.integer("time_us", 0, std::int64_t{1} << 53));
  if (!fields.first_fault() && !stays_inside(frame.file)) {
    fields.fault("file", "must be a relative name inside the recording's folder");
  }
  if (fields.first_fault()) return fail(ErrorCode::kCorruptData, *fields.first_fault(), kAdvice);
  return frame;
}

void take_platform(JsonFields& fields, const json& root, const std::string& where,
                   Recording& recording) {
  if (!root.contains("platform")) return;
  JsonFields platform(root["platform"], where + ": platform");
  recording.platform_height_mm =
      platform.number("height_mm", -kLargestCoordinateMm, kLargestCoordinateMm);
  if (platform.first_fault()) fields.fault(platform.first_fault()->substr(where.size() + 2));
}

void take_truth(JsonFields& fields, const json& root, Recording& recording) {
  if (!root.contains("truth")) return;
  const auto& truth = root["truth"];
  if (!truth.is_object()) return fields.fault("truth", "must be an object of numbers");
  for (const auto& [id, value] : truth.items()) {
    if (!value.is_number() || !(std::abs(value.get<double>()) <= kLargestCoordinateMm)) {
      return fields.fault("truth", "must hold numbers only");
    }
    recording.truth[id] = value.get<double>();
  }
  if (fields.has("simulated") && !recording.simulated) {
    fields.fault("truth", "belongs to simulated recordings, and this one says it is not");
  }
  recording.simulated = true;
}

Result<void> take_cameras(const json& list, const std::string& where, Recording& recording) {
  std::set<std::string> ids;
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto camera = camera_from_json(list[i], fmt::format("{}: camera {}", where, i));
    if (!camera) return tl::make_unexpected(camera.error());
    if (!ids.insert(camera->geometry.id).second) {
      return fail(ErrorCode::kCorruptData,
                  fmt::format("{}: two cameras are called \"{}\"", where, camera->geometry.id),
                  "give each camera an id of its own");
    }
    camera->simulated = recording.simulated;
    recording.cameras.push_back(std::move(*camera));
  }
  return {};
}

Result<void> take_frames(const json& list, const std::string& where, Recording& recording) {
  std::map<std::string, std::chrono::microseconds> latest;
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto frame = frame_from_json(list[i], fmt::format("{}: frame {}", where, i));
    if (!frame) return tl::make_unexpected(frame.error());
    if (recording.find_camera(frame->camera) == nullptr) {
      return fail(ErrorCode::kCorruptData,
                  fmt::format("{}: frame {} is of \"{}\", which is no camera of the recording",
                              where, i, frame->camera.substr(0, 128)),
                  kAdvice);
    }
    const auto [before, first] = latest.try_emplace(frame->camera, frame->time);
    if (!first && frame->time < before->second) {
      return fail(ErrorCode::kCorruptData,
                  fmt::format("{}: frame {} is older than the one before it", where, i),
                  "put the frames of each camera in the order of their time");
    }
    before->second = frame->time;
    recording.frames.push_back(std::move(*frame));
  }
  return {};
}

/// nlohmann reports errors by exceptions and prefixes them with a number in brackets.
Result<json> parse(std::string_view text, const std::string& where) {
  try {
    return json::parse(text.begin(), text.end());
  } catch (const json::exception& error) {
    std::string reason = error.what();
    const auto bracket = reason.find("] ");
    if (bracket != std::string::npos) reason.erase(0, bracket + 2);
    std::replace_if(
        reason.begin(), reason.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; },
        ' ');
    return fail(ErrorCode::kCorruptData, fmt::format("{} is no JSON ({})", where, reason), kAdvice);
  }
}

}  // namespace

std::string recording_to_json(const Recording& recording) {
  json root = {{"format", kFormat}, {"version", kVersion}};
  root["simulated"] = recording.simulated;
  root["cameras"] = json::array();
  for (const auto& camera : recording.cameras) root["cameras"].push_back(camera_to_json(camera));
  root["frames"] = json::array();
  for (const auto& frame : recording.frames) {
    root["frames"].push_back(
        {{"camera", frame.camera}, {"file", frame.file.string()}, {"time_us", frame.time.count()}});
  }
  if (recording.platform_height_mm) {
    root["platform"] = {{"height_mm", *recording.platform_height_mm}};
  }
  if (!recording.truth.empty()) root["truth"] = recording.truth;
  return root.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

Result<Recording> recording_from_json(std::string_view text, const std::filesystem::path& file) {
  const std::string where = file.string();
  const auto root = parse(text, where);
  if (!root) return tl::make_unexpected(root.error());

  JsonFields fields(*root, where);
  if (!root->is_object() || fields.text("format") != kFormat) {
    return fail(ErrorCode::kCorruptData,
                fmt::format("{} is no recording (\"format\" must be \"{}\")", where, kFormat),
                "give the folder of a recording");
  }
  if (const auto version = fields.integer("version", 1, std::numeric_limits<int>::max());
      !fields.first_fault() && version != kVersion) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{} has version {} of the format, and only {} is known", where, version,
                            kVersion),
                "use a newer program");
  }
  Recording recording;
  recording.folder = file.parent_path();
  if (fields.has("simulated")) recording.simulated = fields.boolean("simulated");
  take_platform(fields, *root, where, recording);
  take_truth(fields, *root, recording);
  const auto* cameras = fields.list("cameras", 1, kMostRecordingCameras);
  const auto* frames = fields.list("frames", 1, kMostRecordingFrames);
  if (fields.first_fault()) return fail(ErrorCode::kCorruptData, *fields.first_fault(), kAdvice);

  if (auto good = take_cameras(*cameras, where, recording); !good) {
    return tl::make_unexpected(good.error());
  }
  if (auto good = take_frames(*frames, where, recording); !good) {
    return tl::make_unexpected(good.error());
  }
  return recording;
}

}  // namespace instep
