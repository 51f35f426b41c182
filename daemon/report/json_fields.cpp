#include "daemon/report/json_fields.h"

namespace instep {
namespace {

using nlohmann::json;

const json* find(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

}  // namespace

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
