#include "daemon/repeat/repeat_report.h"

#include <fmt/format.h>

namespace instep {
namespace {

Json measure_json(const RepeatedMeasure& measure) {
  const std::string unit = measure.is_angle ? "_deg" : "_mm";
  const Repeatability& figures = measure.figures;
  Json json{{"id", measure.id},
            {"n", figures.values.size()},
            {"mean" + unit, json_number(figures.mean)},
            {"sd" + unit, json_number(figures.standard_deviation)},
            {"range" + unit, json_number(figures.range())},
            {"mean_absolute_difference" + unit, json_number(figures.mean_absolute_difference)},
            {"least" + unit, json_number(figures.least)},
            {"greatest" + unit, json_number(figures.greatest)},
            {"claimed_u95" + unit, json_number(measure.claimed_u95)}};
  Json& values = json["values" + unit] = Json::array();
  for (const double value : figures.values) values.push_back(json_number(value));
  return json;
}

std::string measure_line(const RepeatedMeasure& measure) {
  const Repeatability& figures = measure.figures;
  const bool over_limit = !measure.is_angle && figures.mean_absolute_difference > kIsoFootLimitMm;
  std::string line = fmt::format(
      "  {:<26}{:>4}{:>9.2f} {:<4}{:>6.2f}{:>8.2f}{:>10.2f}  {:<8}{}", measure.id,
      figures.values.size(), figures.mean, measure.is_angle ? "deg" : "mm",
      figures.standard_deviation, figures.range(), figures.mean_absolute_difference,
      measure.claimed_u95 ? fmt::format("+-{:.2f}", *measure.claimed_u95) : "",
      over_limit ? fmt::format("over the {:.0f} mm of ISO 20685-1", kIsoFootLimitMm) : "");
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string foot_text(const RepeatedFoot& foot) {
  std::string text = fmt::format("{} scans, {} foot\n", foot.scans.size(), foot.side) +
                     fmt::format("  {:<26}{:>4}{:>9} {:<4}{:>6}{:>8}{:>10}  {}\n", "measure", "n",
                                 "mean", "", "SD", "range", "mean |d|", "claimed 95 %");
  for (const auto& measure : foot.measures) text += measure_line(measure);
  return text;
}

}  // namespace

Json repeat_json(const RepeatStudy& study) {
  Json json{{"feet", Json::array()}, {"warnings", study.warnings}};
  for (const auto& foot : study.feet) {
    Json one{{"side", foot.side},
             {"n", foot.scans.size()},
             {"scans", foot.scans},
             {"measures", Json::array()}};
    for (const auto& measure : foot.measures) one["measures"].push_back(measure_json(measure));
    json["feet"].push_back(std::move(one));
  }
  return json;
}

std::string repeat_text(const RepeatStudy& study) {
  std::string text;
  for (const auto& foot : study.feet) text += foot_text(foot);
  for (const auto& warning : study.warnings) text += fmt::format("  note: {}\n", warning);
  return text;
}

}  // namespace instep
