#include "daemon/report/sizes_report.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "daemon/json/untrusted_json.h"

namespace instep {
namespace {

using nlohmann::json;

constexpr double kExactStep = 0.01;
constexpr const char* kGuide =
    "guidance: told from the foot, and no two makers' shoes of one size are alike";

void add_scales(Json& out, const ShoeSizes& sizes) {
  Json exact = Json::object();
  const auto add = [&](const char* scale, const std::optional<MarkedSize>& size) {
    if (!size) return;
    out[scale] = json_number(size->marked, 0.5);
    exact[scale] = json_number(size->exact, kExactStep);
  };
  add("eu", sizes.eu);
  add("uk", sizes.uk);
  add("us_men", sizes.us_men);
  add("us_women", sizes.us_women);
  out["exact"] = std::move(exact);
}

std::string mondopoint_text(const json& sizes) {
  const auto length = number_at(sizes, "mondopoint_mm");
  const auto width = number_at(sizes, "mondopoint_width_mm");
  if (!length) return {};
  return width ? fmt::format("Mondopoint {:.0f}/{:.0f}", *length, *width)
               : fmt::format("Mondopoint {:.0f}", *length);
}

std::string systems_text(const json& sizes) {
  constexpr std::array<std::pair<const char*, const char*>, 4> kScales = {
      {{"eu", "EU"}, {"uk", "UK"}, {"us_men", "US men"}, {"us_women", "US women"}}};
  constexpr std::array<std::pair<const char*, const char*>, 2> kJis = {
      {{"jis_men", "JIS men"}, {"jis_women", "JIS women"}}};
  std::string line = mondopoint_text(sizes);
  const auto append = [&](const std::string& text) { line += (line.empty() ? "" : ", ") + text; };
  for (const auto& [key, name] : kScales) {
    if (const auto size = number_at(sizes, key)) append(fmt::format("{} {}", name, *size));
  }
  for (const auto& [key, name] : kJis) {
    if (const auto size = string_at(sizes, key); !size.empty()) append(name + (" " + size));
  }
  return line;
}

std::string shop_line(const json& choice) {
  const auto size = string_at(choice, "size");
  const auto note = string_at(choice, "note");
  return fmt::format("  {}: {}{}\n", string_at(choice, "table"), size.empty() ? "none" : size,
                     note.empty() ? "" : " (" + note + ")");
}

}  // namespace

Json sizes_json(const ShoeSizes& sizes) {
  Json json = Json::object();
  if (sizes.mondopoint_mm) json["mondopoint_mm"] = json_number(sizes.mondopoint_mm);
  if (sizes.mondopoint_width_mm) {
    json["mondopoint_width_mm"] = json_number(sizes.mondopoint_width_mm);
  }
  add_scales(json, sizes);
  if (sizes.jis_men) json["jis_men"] = *sizes.jis_men;
  if (sizes.jis_women) json["jis_women"] = *sizes.jis_women;
  json["allowance_mm"] = json_number(sizes.allowance_mm);
  json["shop"] = Json::array();
  for (const auto& choice : sizes.shop) {
    json["shop"].push_back({{"table", choice.table},
                            {"size", choice.size ? Json(*choice.size) : Json(nullptr)},
                            {"note", choice.note}});
  }
  json["notes"] = sizes.notes;
  json["guide"] = kGuide;
  return json;
}

std::string sizes_text(const json& sizes) {
  if (!sizes.is_object()) return {};
  std::string text;
  if (const auto systems = systems_text(sizes); !systems.empty()) {
    text += fmt::format("  size guide: {}\n", systems);
  }
  for (const auto& choice : list_at(sizes, "shop")) {
    if (choice.is_object()) text += shop_line(choice);
  }
  for (const auto& note : list_at(sizes, "notes")) {
    if (note.is_string()) text += fmt::format("  size guide: {}\n", note.get<std::string>());
  }
  return text;
}

}  // namespace instep
