#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace instep {

/// The object that a text of JSON holds, read with no trust in it; null if it holds none, or one
/// nested deeper than anything here is, which would use up the stack of who copies it.
nlohmann::json object_in(std::string_view text);

/// What an object of JSON has under a key, read with no trust in it: of another type, or of no
/// object, is as good as not there.
std::string string_at(const nlohmann::json& object, const char* key);
std::optional<double> number_at(const nlohmann::json& object, const char* key);
/// An array; empty if there is none.
nlohmann::json list_at(const nlohmann::json& object, const char* key);

}  // namespace instep
