#include "daemon/control/protocol.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/error_names.h"
#include "daemon/json/untrusted_json.h"
#include "daemon/report/json_number.h"

namespace instep {
namespace {

using nlohmann::json;

struct Verb {
  const char* name;
  bool needs_id;
  bool takes_latest;
};

constexpr std::array<Verb, 8> kVerbs = {{{"scan", false, false},
                                         {"cancel", false, false},
                                         {"status", false, false},
                                         {"watch", false, false},
                                         {"list", false, false},
                                         {"show", true, true},
                                         {"export", true, true},
                                         {"delete", true, false}}};

tl::unexpected<Error> refused(const std::string& message) {
  return fail(ErrorCode::kInvalidInput, message,
              "send one JSON object a line, such as {\"verb\": \"status\"}");
}

tl::unexpected<Error> without_id(const std::string& message) {
  return fail(ErrorCode::kInvalidInput, message, "give the id of a scan: instep list shows them");
}

/// Text from outside may hold bytes that are no UTF-8: they are replaced, never thrown about.
std::string dump(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string with(const json& content, const char* key, const json& value) {
  json object = content.is_object() ? content : json::object();
  object[key] = value;
  return dump(object);
}

json to_json(const FrameCounts& frames) {
  return {{"good", frames.good},
          {"error_flagged", frames.error_flagged},
          {"short", frames.short_of_pixels},
          {"stale", frames.stale},
          {"empty", frames.empty},
          {"lost", frames.lost}};
}

}  // namespace

Result<Request> parse_request(std::string_view line) {
  const json request = object_in(line);
  if (!request.is_object()) return refused("the request is not a JSON object");
  for (const auto& [key, value] : request.items()) {
    if (key != "verb" && key != "id") return refused("the request has an unknown key");
    if (!value.is_string()) return refused("\"" + key + "\" must be text");
  }
  Request parsed{request.value("verb", ""), request.value("id", "")};
  const auto* verb = std::find_if(kVerbs.begin(), kVerbs.end(),
                                  [&](const Verb& one) { return parsed.verb == one.name; });
  if (verb == kVerbs.end()) return refused("there is no such verb");
  if (verb->needs_id && parsed.id.empty()) return without_id(parsed.verb + " needs an id");
  if (!verb->needs_id && !parsed.id.empty()) return refused(parsed.verb + " takes no \"id\"");
  if (parsed.id == "latest" && !verb->takes_latest) {
    return without_id(parsed.verb + " needs the id itself, not \"latest\"");
  }
  return parsed;
}

std::string ok_answer(const json& content) {
  return with(content, "ok", true);
}

std::string error_answer(const Error& error) {
  return dump({{"ok", false}, {"error", to_json(error)}});
}

std::string event_line(const char* event, const json& content) {
  return with(content, "event", event);
}

json to_json(const Error& error) {
  return {{"code", to_string(error.code)},
          {"remedy", to_string(error.remedy)},
          {"message", error.message},
          {"advice", error.advice}};
}

json to_json(const StationStatus& status) {
  // Of what is well or in trouble.
  const auto with_trouble = [](json part, const std::optional<Error>& trouble) {
    part["ok"] = !trouble.has_value();
    part["trouble"] = trouble ? trouble->line() : "";
    part["advice"] = trouble ? trouble->advice : "";  // with which that line ends
    return part;
  };
  json cameras = json::array();
  for (const auto& camera : status.cameras) {
    cameras.push_back(with_trouble({{"id", camera.id},
                                    {"model", camera.model},
                                    {"serial", camera.serial},
                                    {"recovery", camera.health.recovery},
                                    {"link_mbps", camera.health.link_mbps},
                                    {"warning", camera.health.warning},
                                    {"frames", to_json(camera.frames)}},
                                   camera.trouble));
  }
  json outputs = json::array();
  for (const auto& [name, on, trouble] : status.outputs) {
    outputs.push_back(with_trouble({{"name", name}, {"on", on}}, trouble));
  }
  json troubles = json::array();
  for (const auto& trouble : status.troubles) troubles.push_back(trouble.error.line());
  return {{"state", to_string(status.state)},
          {"trouble", status.trouble()},
          {"troubles", troubles},
          {"warnings", status.warnings},
          {"stage", status.stage},
          {"done", json(json_number(status.done))},
          {"cameras", cameras},
          {"pedal", status.pedal ? with_trouble(json::object(), status.pedal->trouble) : json()},
          {"store", with_trouble({{"root", status.store.root.string()}}, status.store.trouble)},
          {"outputs", outputs},
          {"scans", status.scans},
          {"ignored_presses", status.ignored_presses},
          {"last_result", status.last_result}};
}

json to_json(const std::vector<StoredResult>& results) {
  json scans = json::array();
  for (const auto& result : results) {
    scans.push_back(
        {{"id", result.id}, {"folder", result.folder.string()}, {"side", to_string(result.side)}});
  }
  return {{"scans", scans}};
}

Error answer_not_understood() {
  return {ErrorCode::kCorruptData, Remedy::kOperator, "the daemon's answer cannot be understood",
          "check that instep and instepd are of the same version"};
}

Result<void> answer_outcome(const json& answer) {
  if (!answer.is_object()) return tl::make_unexpected(answer_not_understood());
  if (answer.value("ok", json(false)) == json(true)) return {};
  const json error = answer.value("error", json::object());
  const auto code = error_code_from(string_at(error, "code")).value_or(ErrorCode::kInternal);
  const auto remedy = remedy_from(string_at(error, "remedy")).value_or(usual_remedy(code));
  return fail(code, remedy, string_at(error, "message"), string_at(error, "advice"));
}

}  // namespace instep
