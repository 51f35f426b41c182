#include "daemon/json/untrusted_json.h"

namespace instep {
namespace {

using nlohmann::json;

constexpr int kDeepest = 64;

const json* find(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

/// By brackets outside of strings. The library's own look at each level takes the square of a
/// list's length.
bool is_too_deep(std::string_view text) {
  int depth = 0;
  bool is_in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    if (is_in_string && letter == '\\') {
      ++i;
    } else if (letter == '"') {
      is_in_string = !is_in_string;
    } else if (!is_in_string && (letter == '[' || letter == '{')) {
      if (++depth > kDeepest) return true;
    } else if (!is_in_string && (letter == ']' || letter == '}')) {
      --depth;
    }
  }
  return false;
}

}  // namespace

json object_in(std::string_view text) {
  if (is_too_deep(text)) return json();
  json parsed = json::parse(text, nullptr, /*allow_exceptions=*/false);
  return parsed.is_object() ? parsed : json();
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
