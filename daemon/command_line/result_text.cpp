#include "daemon/command_line/result_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "daemon/json/untrusted_json.h"
#include "daemon/report/number_text.h"
#include "daemon/report/sizes_report.h"

namespace instep {
namespace {

using nlohmann::json;

std::string heading(bool with_truth) {
  return fmt::format("  {:<26}{:>8}    {:>8}", "measure", "value", "95 %") +
         (with_truth ? fmt::format("{:>9}{:>8}", "truth", "error") : "") + "\n";
}

std::string measure_line(const json& measure, const json& truth) {
  const std::string id = string_at(measure, "id");
  const bool is_angle = measure.contains("value_deg");
  const auto value = number_at(measure, is_angle ? "value_deg" : "value_mm");
  if (!value) return fmt::format("  {:<26}       -\n", id);
  const auto interval = number_at(measure, is_angle ? "u95_deg" : "u95_mm");
  std::string line = fmt::format("  {:<26}{:>8.1f} {}{:>8}", id, *value, is_angle ? "deg" : "mm ",
                                 interval ? "+-" + interval_tenths(*interval) : "");
  if (const auto known = number_at(truth, id.c_str())) {
    line += fmt::format("{:>9.1f}{:>+8.2f}", *known, *value - *known);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string warning_lines(const json& owner, const std::string& of) {
  std::string lines;
  for (const auto& warning : list_at(owner, "warnings")) {
    if (warning.is_string()) lines += fmt::format("  note: {}{}\n", of, warning.get<std::string>());
  }
  return lines;
}

}  // namespace

std::string result_text(const json& result) {
  if (!result.is_object()) return {};
  const json measures = list_at(result, "measures");
  const json truth = result.value("truth", json::object());
  std::string report =
      fmt::format("scan {}\n{} foot{}\n", string_at(result, "id"), string_at(result, "side"),
                  result.value("simulated", json(false)) == json(true) ? ", simulated" : "") +
      heading(truth.is_object() && !truth.empty());
  std::string notes = warning_lines(result, "");
  for (const auto& measure : measures) {
    if (!measure.is_object()) continue;
    report += measure_line(measure, truth);
    notes += warning_lines(measure, string_at(measure, "id") + ": ");
  }
  for (const auto& withheld : list_at(result, "withheld")) {
    report += fmt::format("  {:<26}       -    {}\n", string_at(withheld, "id"),
                          string_at(withheld, "reason"));
  }
  return report + sizes_text(result.value("sizes", json::object())) + notes;
}

}  // namespace instep
