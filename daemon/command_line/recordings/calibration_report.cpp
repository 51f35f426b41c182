#include "daemon/command_line/recordings/calibration_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/geometry/pose_rows.h"
#include "daemon/report/json_number.h"

namespace instep {
namespace {

std::string known_text(const std::optional<double>& known_to_mm) {
  return known_to_mm ? fmt::format("{:.2f} mm", *known_to_mm) : "-";
}

std::string next_step(const CalibrationReport& report) {
  const std::string file = report.file ? report.file->string() : "";
  switch (report.use) {
    case PosesUse::kPrinted:
      return "nothing is written; --out FILE keeps the poses";
    case PosesUse::kNeedless:
      return "nothing is written: simulated and recorded cameras bring their own poses";
    case PosesUse::kOfStation:
      return fmt::format(
          "written to {}; instepd takes them when it starts: systemctl restart instepd", file);
    case PosesUse::kInFile:
      return fmt::format("written to {}", file);
    case PosesUse::kNotWritten:
      return "nothing is written";
  }
  return "";
}

}  // namespace

Json to_json(const CalibrationReport& report) {
  Json cameras = Json::array();
  for (std::size_t i = 0; i < report.names.size(); ++i) {
    const auto& found = report.poses.cameras[i];
    cameras.push_back({{"name", report.names[i]},
                       {"station_from_camera", pose_rows(found.station_from_camera)},
                       {"moved_mm", json_number(found.moved_mm)},
                       {"turned_deg", json_number(found.turned_deg)},
                       {"u95_mm", json_number(found.known_to_mm)},
                       {"overlap", json_number(found.overlap)},
                       {"apart_mm", json_number(found.apart_mm)},
                       {"sees_platform", found.is_level}});
  }
  return {{"cameras", cameras},
          {"unexplained_mm", json_number(report.poses.unexplained_mm)},
          {"file", report.file ? Json(report.file->string()) : Json()},
          {"warnings", report.poses.warnings}};
}

std::string to_text(const CalibrationReport& report) {
  std::size_t widest = 6;
  for (const auto& name : report.names) widest = std::max(widest, name.size());
  std::string text = fmt::format("{:<{}}  {:>10}  {:>9}  {:>8}  {:>8}  {:>10}\n", "camera", widest,
                                 "moved", "turned", "within", "shares", "apart");
  for (std::size_t i = 0; i < report.names.size(); ++i) {
    const auto& found = report.poses.cameras[i];
    text += fmt::format("{:<{}}  {:>7.1f} mm  {:>5.1f} deg  {:>8}  {:>6.0f} %  {:>7.2f} mm\n",
                        report.names[i], widest, found.moved_mm, found.turned_deg,
                        known_text(found.known_to_mm), 100.0 * found.overlap, found.apart_mm);
  }
  text +=
      "\nmoved, turned: from where it was said to be. within: where it puts the object, against\n"
      "the others, 95 %. shares: of what it sees, with others. apart: from them, half of that.\n";
  for (const auto& warning : report.poses.warnings) text += "warning: " + warning + "\n";
  text += fmt::format("\n{}\n", next_step(report));
  return text;
}

}  // namespace instep
