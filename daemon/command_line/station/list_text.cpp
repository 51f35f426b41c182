#include "daemon/command_line/station/list_text.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <nlohmann/json.hpp>
#include <optional>

#include "daemon/json/untrusted_json.h"
#include "daemon/report/number_text.h"
#include "daemon/scan/scan_id.h"

namespace instep {
namespace {

using nlohmann::json;

std::string beginning(const std::string& id) {
  const auto time = time_of_scan_id(id);
  if (!time) return id + "  no such date     ";
  const std::time_t seconds = std::chrono::system_clock::to_time_t(*time);
  std::tm local{};
  ::localtime_r(&seconds, &local);
  return fmt::format("{}  {:%Y-%m-%d %H:%M}", id, local);
}

/// One that can be of a body, and fits its column.
std::optional<double> length_at(const json& measure, const char* key) {
  constexpr double kBeyondAll_mm = 1e5;
  const auto value = number_at(measure, key);
  const bool is_sound = value && std::isfinite(*value) && std::abs(*value) < kBeyondAll_mm;
  return is_sound ? value : std::nullopt;
}

/// Whoever writes in the store is not to write on the terminal.
std::string side_of(const json& result) {
  auto side = string_at(result, "side");
  return side == "left" || side == "right" ? side : "?";
}

std::string measure_text(const json& result, const std::string& id, const char* name) {
  for (const auto& measure : list_at(result, "measures")) {
    if (string_at(measure, "id") != id) continue;
    const auto value = length_at(measure, "value_mm");
    const auto interval = length_at(measure, "u95_mm");
    if (!value) break;
    return fmt::format("{} {:.1f}{} mm", name, *value,
                       interval ? " +-" + interval_tenths(*interval) : "");
  }
  return fmt::format("no {}", name);
}

std::string counted(std::size_t number, const char* one, const char* many) {
  return fmt::format("{} {}", number, number == 1 ? one : many);
}

std::string doubts(const json& result) {
  std::size_t notes = list_at(result, "warnings").size();
  for (const auto& measure : list_at(result, "measures")) {
    notes += list_at(measure, "warnings").size();
  }
  const std::size_t withheld = list_at(result, "withheld").size();
  std::string text = notes == 0 ? "no note" : counted(notes, "note", "notes");
  if (withheld > 0) text += ", " + counted(withheld, "measure withheld", "measures withheld");
  const bool is_simulated = result.is_object() && result.value("simulated", json()) == json(true);
  return text + (is_simulated ? ", simulated" : "");
}

}  // namespace

std::string list_line(const std::string& id, const json& result) {
  return fmt::format("{}  {:<5}  {:<22}  {:<20}  {}\n", beginning(id), side_of(result),
                     measure_text(result, "foot_length", "length"),
                     measure_text(result, "ball_girth", "ball"), doubts(result));
}

std::string list_line_without_result(const std::string& id, const std::string& reason) {
  return fmt::format("{}  {}\n", beginning(id), reason);
}

}  // namespace instep
