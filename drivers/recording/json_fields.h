#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"

namespace instep {

/// Takes values out of a JSON object, demanding their kind, and remembers the first fault. So a
/// list of fields is read as a list of lines, and the fault is asked for once at the end.
class JsonFields {
 public:
  /// `where` names the object in messages: "recording.json: camera 2". Borrows `object`.
  JsonFields(const nlohmann::json& object, std::string where)
      : object_(object), where_(std::move(where)) {
    if (!object.is_object()) fault("is no JSON object");
  }

  bool has(const char* key) const { return object_.is_object() && object_.contains(key); }

  std::string text(const char* key) {
    const auto* value = find(key);
    if (value == nullptr) return {};
    if (!value->is_string()) return fault(key, "must be a text"), std::string{};
    return value->get<std::string>();
  }

  bool boolean(const char* key) {
    const auto* value = find(key);
    if (value == nullptr) return false;
    if (!value->is_boolean()) return fault(key, "must be true or false"), false;
    return value->get<bool>();
  }

  double number(const char* key, double lowest, double highest) {
    const auto* value = find(key);
    if (value == nullptr) return 0.0;
    if (!value->is_number()) return fault(key, "must be a number"), 0.0;
    const double taken = value->get<double>();
    if (!(taken >= lowest && taken <= highest)) {
      fault(key, "must lie between " + shown(lowest) + " and " + shown(highest));
    }
    return taken;
  }

  std::int64_t integer(const char* key, std::int64_t lowest, std::int64_t highest) {
    const auto* value = find(key);
    if (value == nullptr) return 0;
    if (!value->is_number_integer()) return fault(key, "must be a whole number"), 0;
    const bool too_large = value->is_number_unsigned() &&
                           value->get<std::uint64_t>() > static_cast<std::uint64_t>(highest);
    const auto taken = too_large ? highest : value->get<std::int64_t>();
    if (too_large || taken < lowest || taken > highest) {
      fault(key, "must lie between " + std::to_string(lowest) + " and " + std::to_string(highest));
    }
    return taken;
  }

  /// Exactly `count` finite numbers.
  std::vector<double> numbers(const char* key, std::size_t count) {
    std::vector<double> taken(count, 0.0);
    const auto* value = find(key);
    if (value == nullptr) return taken;
    if (!value->is_array() || value->size() != count) {
      fault(key, "must be a list of " + std::to_string(count) + " numbers");
      return taken;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto& item = (*value)[i];
      if (!item.is_number()) return fault(key, "must hold numbers only"), taken;
      taken[i] = item.get<double>();
    }
    return taken;
  }

  /// A list of `least` to `most` items, or nullptr.
  const nlohmann::json* list(const char* key, std::size_t least, std::size_t most) {
    const auto* value = find(key);
    if (value == nullptr) return nullptr;
    if (!value->is_array()) return fault(key, "must be a list"), nullptr;
    if (value->size() < least || value->size() > most) {
      fault(key, "must have " + std::to_string(least) + " to " + std::to_string(most) +
                     " entries, not " + std::to_string(value->size()));
      return nullptr;
    }
    return value;
  }

  void fault(const char* key, const std::string& what) {
    fault(fmt::format("\"{}\" {}", key, what));
  }
  void fault(const std::string& what) {
    if (!fault_) fault_ = where_ + ": " + what;
  }

  /// Nothing, or the first fault.
  const std::optional<std::string>& first_fault() const { return fault_; }

 private:
  const nlohmann::json* find(const char* key) {
    if (!object_.is_object()) return nullptr;
    const auto found = object_.find(key);
    if (found != object_.end()) return &*found;
    fault(key, "is missing");
    return nullptr;
  }

  static std::string shown(double value) { return nlohmann::json(value).dump(); }

  const nlohmann::json& object_;
  std::string where_;
  std::optional<std::string> fault_;
};

}  // namespace instep
