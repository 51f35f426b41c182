#include "daemon/control/store_requests.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "daemon/json/untrusted_json.h"
#include "daemon/scan/scan_id.h"

namespace instep {
namespace {

using nlohmann::json;

Result<json> list(const ResultStore& store, const ResultStore::OnDay& on_day) {
  const auto ids = store.list(on_day);
  if (!ids) return tl::make_unexpected(ids.error());
  json scans = json::array();
  for (const auto& id : *ids) scans.push_back({{"id", id}});
  return json{{"scans", scans}};
}

Result<json> show(const ResultStore& store, const std::string& id) {
  const char* const advice = "restore it from a copy, or delete the scan";
  const auto text = store.read_result_json(id);
  if (!text && text.error().code == ErrorCode::kNotFound) {
    return fail(ErrorCode::kCorruptData, "scan " + id + " has no result.json", advice);
  }
  if (!text) return tl::make_unexpected(text.error());
  json result = object_in(*text);
  if (!result.is_object() || !result.value("measures", json()).is_array()) {
    return fail(ErrorCode::kCorruptData, "result.json of scan " + id + " is damaged", advice);
  }
  return json{{"id", id}, {"folder", store.folder_of(id).string()}, {"result", std::move(result)}};
}

/// Of a pair, the scan of the other foot, if it is still there. It holds the numbers of both.
std::optional<std::string> pair_of(const ResultStore& store, const std::string& id) {
  const auto text = store.read_result_json(id);
  if (!text) return std::nullopt;
  const json result = object_in(*text);
  const auto pair = result.is_object() ? result.value("pair", json()) : json();
  for (const char* side : {"left", "right"}) {
    const std::string other = string_at(pair, side);
    if (other != id && is_scan_id(other) && store.find(other)) return other;
  }
  return std::nullopt;
}

/// What a result consists of; the page to print may be missing, as somebody may have taken it away.
json files_in(const std::filesystem::path& folder) {
  json files = {"result.json", "cloud.ply", "sections.svg"};
  std::error_code missing;
  if (std::filesystem::exists(folder / "report.svg", missing)) files.push_back("report.svg");
  return files;
}

Result<json> answer(ResultStore& store, const Request& request, const ResultStore::OnDay& on_day) {
  // A folder in the place of the results' own would be shown as one without results.
  if (const auto there = store.check_root(); !there) return tl::make_unexpected(there.error());
  if (request.verb == "list") return list(store, on_day);
  const auto id = store.find(request.id);
  if (!id) return tl::make_unexpected(id.error());
  if (request.verb == "show") return show(store, *id);
  if (request.verb == "export") {
    return json{{"id", *id},
                {"folder", store.folder_of(*id).string()},
                {"files", files_in(store.folder_of(*id))}};
  }
  const auto pair = pair_of(store, *id);
  const auto removed = store.remove(*id);
  if (!removed) return tl::make_unexpected(removed.error());
  json deleted{{"id", *id}};
  if (pair) deleted["pair"] = *pair;
  return deleted;
}

}  // namespace

std::string answer_from_store(ResultStore& store, const Request& request,
                              const ResultStore::OnDay& on_day) {
  const auto content = answer(store, request, on_day);
  return content ? ok_answer(*content) : error_answer(content.error());
}

}  // namespace instep
