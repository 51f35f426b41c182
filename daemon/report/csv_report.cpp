#include "daemon/report/csv_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "daemon/json/untrusted_json.h"

namespace instep {
namespace {

using nlohmann::json;

std::string cell(const json& measure, const char* key) {
  const auto value = number_at(measure, key);
  return value ? fmt::format("{:.3f}", *value) : std::string();
}

std::string quoted(const std::string& text) {
  std::string doubled;
  for (const char letter : text) {
    doubled += letter;
    if (letter == '"') doubled += letter;
  }
  return "\"" + doubled + "\"";
}

std::string warnings_of(const json& measure) {
  std::string text;
  for (const auto& warning : list_at(measure, "warnings")) {
    if (!warning.is_string()) continue;
    text += (text.empty() ? "" : "; ") + warning.get<std::string>();
  }
  return text;
}

}  // namespace

std::string result_csv(const json& result) {
  const std::string side = string_at(result, "side");
  const std::string axis = string_at(result, "axis");
  std::string text =
      "side,id,value_mm,u95_mm,contact_mm,warnings,value_deg,u95_deg,definition,axis\n";
  for (const auto& measure : list_at(result, "measures")) {
    const std::string id = string_at(measure, "id");
    if (id.empty()) continue;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", side, id, cell(measure, "value_mm"),
                        cell(measure, "u95_mm"), cell(measure, "contact_mm"),
                        quoted(warnings_of(measure)), cell(measure, "value_deg"),
                        cell(measure, "u95_deg"), quoted(string_at(measure, "definition")), axis);
  }
  for (const auto& withheld : list_at(result, "withheld")) {
    text += fmt::format("{},{},,,,{},,,,{}\n", side, string_at(withheld, "id"),
                        quoted(string_at(withheld, "reason")), axis);
  }
  return text;
}

}  // namespace instep
