#include "daemon/command_line/doctor/daemon_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "daemon/command_line/doctor/closed_check.h"
#include "daemon/command_line/doctor/store_check.h"
#include "daemon/json/untrusted_json.h"

namespace instep {
namespace {

using nlohmann::json;

constexpr const char* kMendThat = "mend that, then: instep status";

/// A member that is an object; null if there is none.
json part_at(const json& status, const char* key) {
  return status.is_object() ? status.value(key, json()) : json();
}

bool is_well(const json& part) {
  return part.is_object() && part.value("ok", json()) == json(true);
}

/// The trouble of a part, and its advice, which a daemon of an earlier version told in one.
OutputFinding finding_of(const json& part) {
  std::string trouble = string_at(part, "trouble");
  const std::string advice = string_at(part, "advice");
  const std::string end = ": " + advice;
  if (advice.empty() || !trouble.ends_with(end)) return {{}, std::move(trouble), kMendThat};
  trouble.erase(trouble.size() - end.size());
  return {{}, std::move(trouble), advice};
}

DoctorCheck bad_part(const char* name, const json& part) {
  auto finding = finding_of(part);
  return bad_check(name, std::move(finding.trouble), std::move(finding.remedy));
}

/// Of a part that has a check of its own.
std::set<std::string> troubles_of_parts(const json& status) {
  std::set<std::string> all{string_at(part_at(status, "pedal"), "trouble"),
                            string_at(part_at(status, "store"), "trouble")};
  for (const auto& camera : list_at(status, "cameras")) all.insert(string_at(camera, "trouble"));
  return all;
}

std::vector<std::string> troubles_of(const json& status) {
  std::vector<std::string> all;
  for (const auto& trouble : list_at(status, "troubles")) {
    if (trouble.is_string()) all.push_back(trouble.get<std::string>());
  }
  const auto first = string_at(status, "trouble");
  if (all.empty() && !first.empty()) all.push_back(first);
  return all;
}

/// Those that no part tells.
std::vector<std::string> its_own_troubles(const json& status) {
  const auto all = troubles_of(status);
  const auto of_parts = troubles_of_parts(status);
  std::vector<std::string> its_own;
  std::copy_if(all.begin(), all.end(), std::back_inserter(its_own),
               [&](const auto& trouble) { return !of_parts.contains(trouble); });
  return its_own;
}

/// It takes up to a minute, where several wait for each other.
DoctorCheck cameras_that_open() {
  return bad_check("cameras", "none is open yet", "instep status --wait-ready 60");
}

}  // namespace

DoctorCheck check_daemon(const Result<json>& status, const std::filesystem::path& socket) {
  if (!status) {
    Error error = status.error();
    if (error.code == ErrorCode::kTimeout) error.advice = "sudo systemctl restart instepd";
    return failed_check("daemon", error);
  }
  const auto its_own = its_own_troubles(*status);
  const auto state = string_at(*status, "state");
  if (!its_own.empty()) {
    return bad_check("daemon", fmt::format("{}: {}", state, fmt::join(its_own, "; ")), kMendThat);
  }
  return good_check(
      "daemon",
      fmt::format("{}{}, answers on {}", state,
                  troubles_of(*status).empty() ? "" : " for what is wrong here", socket.string()));
}

DoctorCheck check_store_of(const json& status, const std::filesystem::path& root,
                           std::optional<uid_t> daemon) {
  const json store = part_at(status, "store");
  if (!string_at(store, "trouble").empty()) return bad_part("store", store);
  const std::string its_root = string_at(store, "root");
  if (!its_root.empty() &&
      std::filesystem::path(its_root).lexically_normal() != root.lexically_normal()) {
    return bad_check("store",
                     "the daemon keeps results in " + its_root +
                         ", and the settings that the doctor sees say " + root.string(),
                     "if the settings were changed since it began: sudo systemctl restart instepd; "
                     "else give INSTEP_STORE and INSTEP_CONFIG to both alike, or to neither");
  }
  return check_store(root, daemon);
}

std::optional<DoctorCheck> check_pedal_of(const json& status) {
  const json pedal = part_at(status, "pedal");
  if (!pedal.is_object()) return std::nullopt;
  if (string_at(pedal, "trouble").empty()) return good_check("pedal", "is there");
  return bad_part("pedal", pedal);
}

DoctorCheck no_cameras() {
  return bad_check("cameras", "none is open",
                   "plug them in, then see which are found: instep devices");
}

std::vector<DoctorCheck> check_cameras_of(const json& status, const VideoTroubles& video) {
  std::vector<DoctorCheck> checks;
  const json cameras = list_at(status, "cameras");
  // Why none is open is a trouble that no part tells, if it is known.
  if (cameras.empty() && its_own_troubles(status).empty()) {
    return {string_at(status, "state") == "starting" ? cameras_that_open() : no_cameras()};
  }
  std::size_t answer = 0;
  for (const auto& camera : cameras) {
    const auto shown = video.find(string_at(camera, "id"));
    const bool is_shown = shown != video.end() && shown->second;
    if (is_well(camera)) {
      ++answer;
    } else if (!is_shown) {
      checks.push_back(bad_part("camera", camera));
    }
  }
  if (answer > 0 && answer == cameras.size()) {
    checks.push_back(good_check("cameras", fmt::format("all {} answer", answer)));
  }
  return checks;
}

VideoTroubles without_those_of(const json& status, VideoTroubles video) {
  for (const auto& camera : list_at(status, "cameras")) {
    const auto shown = video.find(string_at(camera, "id"));
    if (shown != video.end() && shown->second && shown->second->is_closed) video.erase(shown);
  }
  return video;
}

std::vector<DoctorCheck> check_video_cameras(const VideoTroubles& video,
                                             std::optional<uid_t> daemon) {
  std::vector<DoctorCheck> checks;
  for (const auto& [name, trouble] : video) {
    if (!trouble) {
      checks.push_back(good_check("camera", name + " is plugged in and may be opened"));
      continue;
    }
    const std::string finding = name + ": " + trouble->finding;
    checks.push_back(trouble->is_closed ? closed_check("camera", finding, trouble->remedy, daemon)
                                        : bad_check("camera", finding, trouble->remedy));
  }
  return checks;
}

std::vector<OutputFinding> outputs_of(const json& status) {
  std::vector<OutputFinding> all;
  for (const auto& output : list_at(status, "outputs")) {
    auto finding = finding_of(output);
    finding.name = string_at(output, "name");
    all.push_back(std::move(finding));
  }
  return all;
}

std::vector<DoctorCheck> check_outputs(const std::vector<OutputFinding>& outputs,
                                       const char* there) {
  std::vector<DoctorCheck> checks;
  std::set<std::string> told;
  for (const auto& output : outputs) {
    if (output.trouble.empty()) {
      checks.push_back(good_check("output", output.name + " " + there));
      continue;
    }
    if (!told.insert(output.trouble).second) continue;
    std::vector<std::string> names;
    for (const auto& one : outputs) {
      if (one.trouble == output.trouble) names.push_back(one.name);
    }
    const auto finding = fmt::format("{}: {}", fmt::join(names, ", "), output.trouble);
    checks.push_back(output.is_closed ? closed_check("output", finding, output.remedy)
                                      : bad_check("output", finding, output.remedy));
  }
  return checks;
}

}  // namespace instep
