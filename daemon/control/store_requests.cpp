#include "daemon/control/store_requests.h"

#include <nlohmann/json.hpp>

namespace instep {
namespace {

using nlohmann::json;

Result<json> list(const ResultStore& store) {
  const auto ids = store.list();
  if (!ids) return tl::make_unexpected(ids.error());
  json scans = json::array();
  for (const auto& id : *ids) scans.push_back({{"id", id}});
  return json{{"scans", scans}};
}

Result<json> show(const ResultStore& store, const std::string& id) {
  const auto text = store.read_result_json(id);
  if (!text) return tl::make_unexpected(text.error());
  json result = json::parse(*text, nullptr, false);
  if (!result.is_object()) {
    return fail(ErrorCode::kCorruptData, "result.json of scan " + id + " is damaged",
                "restore it from a copy, or delete the scan");
  }
  return json{{"id", id}, {"folder", store.folder_of(id).string()}, {"result", std::move(result)}};
}

Result<json> answer(ResultStore& store, const Request& request) {
  if (request.verb == "list") return list(store);
  const auto id = store.find(request.id);
  if (!id) return tl::make_unexpected(id.error());
  if (request.verb == "show") return show(store, *id);
  if (request.verb == "export") {
    return json{{"id", *id},
                {"folder", store.folder_of(*id).string()},
                {"files", {"result.json", "cloud.ply", "sections.svg", "report.svg"}}};
  }
  const auto removed = store.remove(*id);
  if (!removed) return tl::make_unexpected(removed.error());
  return json{{"id", *id}};
}

}  // namespace

std::string answer_from_store(ResultStore& store, const Request& request) {
  const auto content = answer(store, request);
  return content ? ok_answer(*content) : error_answer(content.error());
}

}  // namespace instep
