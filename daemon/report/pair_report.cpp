#include "daemon/report/pair_report.h"

#include <fmt/format.h>

#include "daemon/json/untrusted_json.h"
#include "daemon/report/number_text.h"
#include "daemon/report/sizes_report.h"

namespace instep {
namespace {

using nlohmann::json;

Json side_json(const std::optional<Side>& side) {
  return side ? Json(to_string(*side)) : Json(nullptr);
}

std::string measure_line(const json& measure) {
  const auto left = number_at(measure, "left_mm");
  const auto right = number_at(measure, "right_mm");
  const auto difference = number_at(measure, "difference_mm");
  if (!left || !right || !difference) return {};
  const auto interval = number_at(measure, "u95_mm");
  std::string line = fmt::format(
      "  {:<26}{:>8.1f}{:>8.1f}{:>+8.1f} {:<7}{}", string_at(measure, "id"), *left, *right,
      *difference, interval ? "+-" + interval_tenths(*interval) : "", string_at(measure, "larger"));
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string leading_line(const json& pair) {
  const auto leads = string_at(pair, "leads");
  if (leads.empty()) return "  neither foot can be called longer\n";
  return fmt::format("  the {} foot is longer and leads\n", leads);
}

}  // namespace

Json pair_json(const ScannedPair& pair) {
  Json json{{"left", pair.left_id},
            {"right", pair.right_id},
            {"leads", side_json(pair.feet.leading())},
            {"measures", Json::array()}};
  for (const auto& measure : pair.feet.measures) {
    json["measures"].push_back({{"id", measure.id},
                                {"left_mm", json_number(measure.left_mm)},
                                {"right_mm", json_number(measure.right_mm)},
                                {"difference_mm", json_number(measure.difference_mm())},
                                {"u95_mm", json_number(measure.u95_mm)},
                                {"larger", side_json(measure.larger())}});
  }
  json["of_one_foot"] = pair.feet.of_one_foot;
  json["sizes"] = sizes_json(pair.sizes);
  return json;
}

std::string pair_text(const json& pair) {
  if (!pair.is_object()) return {};
  std::string text = fmt::format("both feet\n  {:<26}{:>8}{:>8}{:>8} {:<7}{}\n", "measure", "left",
                                 "right", "differ", "95 %", "larger");
  for (const auto& measure : list_at(pair, "measures")) {
    if (measure.is_object()) text += measure_line(measure);
  }
  for (const auto& id : list_at(pair, "of_one_foot")) {
    if (id.is_string()) {
      text += fmt::format("  {:<26}of one foot only\n", id.get<std::string>());
    }
  }
  text += leading_line(pair);
  const auto sizes = pair.find("sizes");
  return sizes == pair.end() ? text : text + sizes_text(*sizes);
}

}  // namespace instep
