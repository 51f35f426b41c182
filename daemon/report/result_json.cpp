#include "daemon/report/result_json.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>

#include "core/geometry/pose_rows.h"
#include "daemon/build_facts.h"
#include "daemon/report/pair_report.h"
#include "daemon/report/sizes_report.h"

namespace instep {
namespace {

/// One girth of one cloud is asked for to compare methods, on exact shapes to less than 0.001 mm.
constexpr double kComparedMm = 1e-6;

Json coordinates(const Eigen::Vector3d& point) {
  return Json::array({json_number(point.x()), json_number(point.y()), json_number(point.z())});
}

Json matrix(const RigidTransform& transform) {
  Json rows = Json::array();
  for (const double number : pose_rows(transform)) rows.push_back(json_number(number, 1e-9));
  return rows;
}

Json numbers(const std::map<std::string, double>& values) {
  Json object = Json::object();
  for (const auto& [name, value] : values) object[name] = json_number(value);
  return object;
}

/// ISO 8601 in UTC, to the millisecond.
std::string utc(std::chrono::system_clock::time_point time) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(time);
  const auto milliseconds = std::chrono::floor<std::chrono::milliseconds>(time - seconds).count();
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)), milliseconds);
}

Json landmark_json(const Landmark& landmark) {
  return {{"xyz_mm", coordinates(landmark.position_mm)},
          {"confidence", json_number(landmark.confidence)},
          {"u95_mm", json_number(landmark.radius_mm)},
          {"rule", landmark.rule}};
}

Json measure_json(const Measure& measure) {
  const std::string unit = measure.value_deg ? "_deg" : "_mm";
  Json json{{"id", measure.id},
            {"value" + unit, json_number(measure.value())},
            {"u95" + unit, json_number(measure.u95())}};
  if (measure.parts) {
    json["surface_u95" + unit] = json_number(measure.parts->surface);
    json["landmarks_u95" + unit] = json_number(measure.parts->landmarks);
  }
  if (measure.girth) {
    json["stretched_mm"] = json_number(measure.girth->stretched_mm);
    json["contact_mm"] = json_number(measure.girth->contact_mm);
    json["largest_gap_mm"] = json_number(measure.girth->largest_gap_mm);
  }
  if (measure.plane) {
    json["plane"] = Json::array();
    for (const auto& point : measure.plane->control_points()) {
      json["plane"].push_back(coordinates(point));
    }
  }
  json["definition"] = measure.definition;
  json["warnings"] = measure.warnings;
  return json;
}

Json device_json(const CameraDescription& device) {
  return {{"id", device.geometry.id},
          {"model", device.model},
          {"serial", device.serial},
          {"depth_unit_mm", json_number(device.depth_unit_mm, 1e-6)},
          {"simulated", device.simulated}};
}

}  // namespace

Json girth_json(const std::string& method, const Girth& girth, const GirthTimes& times) {
  return {{"method", method},
          {"stretched_mm", json_number(girth.stretched_mm, kComparedMm)},
          {"contact_mm", json_number(girth.contact_mm, kComparedMm)},
          {"stretched_u95_mm", json_number(girth.stretched_u95_mm, kComparedMm)},
          {"contact_u95_mm", json_number(girth.contact_u95_mm, kComparedMm)},
          {"points", girth.points},
          {"band_points", girth.band_points},
          {"sigma_mm", json_number(girth.sigma_mm, kComparedMm)},
          {"largest_gap_mm", json_number(girth.largest_gap_mm)},
          {"warnings", girth.warnings},
          {"elapsed_ms",
           {{"read", json_number(times.read_ms)},
            {"measure", json_number(times.measure_ms)},
            {"total", json_number(times.total_ms)}}}};
}

Json foot_json(const FootScan& foot, const MeasureSet& measures, const ShoeSizes& sizes) {
  Json json{{"side", to_string(foot.side)},
            {"side_confidence", json_number(foot.side_confidence)},
            {"frame", matrix(foot.foot_from_input)},
            {"axis", name_of(foot.rules.axis, kAxisRules)}};
  json["landmarks"] = Json::object();
  for (const auto& [name, landmark] : foot.landmarks) {
    json["landmarks"][name] = landmark_json(landmark);
  }
  json["measures"] = Json::array();
  for (const auto& measure : measures.measures) json["measures"].push_back(measure_json(measure));
  json["withheld"] = Json::array();
  for (const auto& withheld : measures.withheld) {
    json["withheld"].push_back({{"id", withheld.id}, {"reason", withheld.reason}});
  }
  json["sizes"] = sizes_json(sizes);
  json["warnings"] = foot.warnings;
  return json;
}

Json result_json(const ScanRecord& record) {
  Json json{{"id", record.id},
            {"time", utc(record.time)},
            {"station", record.station},
            {"software", {{"name", "instep"}, {"version", program_version()}}}};
  json["devices"] = Json::array();
  for (const auto& device : record.devices) json["devices"].push_back(device_json(device));
  json["calibration"] = record.calibration;
  json["simulated"] = record.simulated;
  json["timings_ms"] = numbers(record.timings_ms);
  json["quality"] = numbers(record.quality);
  Json foot = foot_json(record.foot, record.measures, record.sizes);
  std::vector<std::string> warnings = record.warnings;
  warnings.insert(warnings.end(), record.foot.warnings.begin(), record.foot.warnings.end());
  foot["warnings"] = warnings;
  json.update(foot);
  if (record.pair) json["pair"] = pair_json(*record.pair);
  if (!record.truth.empty()) json["truth"] = numbers(record.truth);
  return json;
}

}  // namespace instep
