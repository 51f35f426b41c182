#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace instep {

/// What an object of JSON has under a key, read with no trust in it: of another type, or of no
/// object, is as good as not there.
std::string string_at(const nlohmann::json& object, const char* key);
std::optional<double> number_at(const nlohmann::json& object, const char* key);
/// An array; empty if there is none.
nlohmann::json list_at(const nlohmann::json& object, const char* key);

}  // namespace instep
