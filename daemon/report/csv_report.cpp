#include "daemon/report/csv_report.h"

#include <fmt/format.h>

#include <cmath>

namespace instep {
namespace {

std::string cell(double value) {
  return std::isfinite(value) ? fmt::format("{:.3f}", value) : std::string();
}

std::string quoted(const std::string& text) {
  std::string doubled;
  for (const char letter : text) {
    doubled += letter;
    if (letter == '"') doubled += letter;
  }
  return "\"" + doubled + "\"";
}

std::string joined(const std::vector<std::string>& warnings) {
  std::string text;
  for (const auto& warning : warnings) text += (text.empty() ? "" : "; ") + warning;
  return text;
}

}  // namespace

std::string foot_csv(const FootScan& foot, const MeasureSet& measures) {
  std::string text = "side,id,value_mm,u95_mm,contact_mm,warnings\n";
  const auto add = [&](const std::string& id, const std::string& value, const std::string& u95,
                       const std::string& contact, const std::string& warnings) {
    text += fmt::format("{},{},{},{},{},{}\n", to_string(foot.side), id, value, u95, contact,
                        quoted(warnings));
  };
  for (const auto& measure : measures.measures) {
    add(measure.id, cell(measure.value_mm), measure.u95_mm ? cell(*measure.u95_mm) : "",
        measure.girth ? cell(measure.girth->contact_mm) : "", joined(measure.warnings));
  }
  for (const auto& withheld : measures.withheld) add(withheld.id, "", "", "", withheld.reason);
  return text;
}

}  // namespace instep
