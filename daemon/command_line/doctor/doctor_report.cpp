#include "daemon/command_line/doctor/doctor_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace instep {
namespace {

const char* verdict_on(const DoctorCheck& check) {
  if (check.unseen) return "?";
  return check.good ? "ok" : "WRONG";
}

}  // namespace

std::string to_text(const std::vector<DoctorCheck>& checks) {
  std::string text;
  for (const auto& check : checks) {
    text += fmt::format("{:<5} {:<11} {}\n", verdict_on(check), check.name, check.finding);
    if (!check.good) text += fmt::format("      {:<11} -> {}\n", "", check.remedy);
  }
  return text;
}

nlohmann::ordered_json to_json(const std::vector<DoctorCheck>& checks) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const auto& check : checks) {
    list.push_back({{"name", check.name},
                    {"good", check.unseen ? Json() : Json(check.good)},
                    {"finding", check.finding},
                    {"remedy", check.remedy}});
  }
  return {{"checks", list}};
}

}  // namespace instep
