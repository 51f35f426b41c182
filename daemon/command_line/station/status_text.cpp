#include "daemon/command_line/station/status_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "daemon/json/untrusted_json.h"

namespace instep {
namespace {

using nlohmann::json;

bool is_true(const json& object, const char* key) {
  return object.is_object() && object.value(key, json()) == true;
}

std::uint64_t count_at(const json& object, const char* key) {
  return static_cast<std::uint64_t>(std::max(number_at(object, key).value_or(0.0), 0.0));
}

/// Such as "(frames: 120 good, 3 short, 1 lost)"; empty if all were good.
std::string damage_text(const json& frames) {
  if (!frames.is_object()) return {};
  std::string damage;
  for (const auto& [kind, count] : frames.items()) {
    if (kind == "good" || !count.is_number_unsigned() || count == 0) continue;
    damage += fmt::format(", {} {}", count.get<std::uint64_t>(),
                          kind == "error_flagged" ? "error-flagged" : kind);
  }
  if (damage.empty()) return {};
  return fmt::format(" (frames: {} good{})", count_at(frames, "good"), damage);
}

std::string camera_text(const json& camera) {
  const std::string damage =
      camera.is_object() ? damage_text(camera.value("frames", json())) : std::string();
  const std::string warning = string_at(camera, "warning");
  if (is_true(camera, "ok")) return (warning.empty() ? "ok" : "ok, but " + warning) + damage;
  const std::string recovery = string_at(camera, "recovery");
  return string_at(camera, "trouble") + (recovery.empty() ? "" : " (" + recovery + ")") + damage;
}

/// What is said of each output, with the names of those it is said of.
std::string outputs_text(const json& outputs) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const auto& output : outputs) {
    const std::string name = string_at(output, "name");
    const std::string trouble = string_at(output, "trouble");
    const std::string said = !trouble.empty() ? trouble : is_true(output, "on") ? "on" : "off";
    const auto known = std::find_if(lines.begin(), lines.end(), [&](const auto& line) {
      return !trouble.empty() && line.second == trouble;
    });
    if (known == lines.end()) {
      lines.emplace_back(name, said);
    } else {
      known->first += ", " + name;
    }
  }
  std::string text;
  for (const auto& [names, said] : lines) text += fmt::format("  {:<19} {}\n", names, said);
  return text;
}

}  // namespace

std::string status_line(const json& status) {
  std::string line = string_at(status, "state");
  if (const auto stage = string_at(status, "stage"); !stage.empty()) {
    line += fmt::format(": {} {:.0f} %", stage, 100 * number_at(status, "done").value_or(0.0));
  }
  if (const auto trouble = string_at(status, "trouble"); !trouble.empty()) line += ": " + trouble;
  return line;
}

std::string live_line(const json& status) {
  constexpr std::size_t kBarWidth = 30;
  std::string line = string_at(status, "state");
  if (const auto stage = string_at(status, "stage"); !stage.empty()) {
    const double done = std::clamp(number_at(status, "done").value_or(0.0), 0.0, 1.0);
    const auto filled = static_cast<std::size_t>(done * kBarWidth);
    line = fmt::format("[{:<{}}] {:>3.0f} % {}", std::string(filled, '#'), kBarWidth, 100 * done,
                       stage);
  } else if (const auto trouble = string_at(status, "trouble"); !trouble.empty()) {
    line += ": " + trouble;
  }
  return "\r\033[K" + line;
}

std::string status_text(const json& status) {
  std::string lines = status_line(status) + "\n";
  for (const auto& warning : list_at(status, "warnings")) {
    if (warning.is_string()) lines += "  warning: " + warning.get<std::string>() + "\n";
  }
  for (const auto& camera : list_at(status, "cameras")) {
    lines += fmt::format("  camera {:<12} {}\n", string_at(camera, "id"), camera_text(camera));
  }
  for (const auto& [part, name] : {std::pair{"store", "results"}, {"pedal", "pedal"}}) {
    const json told = status.is_object() ? status.value(part, json()) : json();
    const std::string trouble = string_at(told, "trouble");
    if (!trouble.empty()) lines += fmt::format("  {:<19} {}\n", name, trouble);
  }
  lines += outputs_text(list_at(status, "outputs"));
  return lines + fmt::format("  scans {}, ignored presses {}\n", count_at(status, "scans"),
                             count_at(status, "ignored_presses"));
}

}  // namespace instep
