#include "daemon/report/json_fields.h"

namespace instep {
namespace {

using nlohmann::json;

constexpr int kDeepest = 64;

const json* find(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

}  // namespace

json object_in(std::string_view text) {
  bool is_too_deep = false;
  const auto look = [&](int depth, json::parse_event_t, json&) {
    is_too_deep = is_too_deep || depth > kDeepest;
    return !is_too_deep;
  };
  json parsed = json::parse(text, look, /*allow_exceptions=*/false);
  return parsed.is_object() && !is_too_deep ? parsed : json();
}

std::string string_at(const json& object, const char* key) {
  const json* found = find(object, key);
  return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<double> number_at(const json& object, const char* key) {
  const json* found = find(object, key);
  if (found == nullptr || !found->is_number()) return {};
  return found->get<double>();
}

json list_at(const json& object, const char* key) {
  const json* found = find(object, key);
  return found != nullptr && found->is_array() ? *found : json::array();
}

}  // namespace instep
