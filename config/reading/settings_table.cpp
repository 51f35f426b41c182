#include "config/reading/settings_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/reading/nearest_word.h"
#include "config/reading/printable_text.h"

namespace instep {
namespace {

std::string quoted(const std::vector<std::string>& words) {
  std::string list;
  for (const auto& word : words) list += (list.empty() ? "\"" : ", \"") + word + "\"";
  return list;
}

const char* kind_of(const toml::node& node) {
  if (node.is_string()) return "text";
  if (node.is_integer()) return "a whole number";
  if (node.is_floating_point()) return "a number";
  if (node.is_boolean()) return "true or false";
  if (node.is_table()) return "a table";
  if (node.is_array()) return "a list";
  return "a date or time";
}

/// Of text in UTF-8: bytes that begin one.
std::size_t letters_in(const std::string& text) {
  const auto begins_one = [](char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
  };
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_one));
}

}  // namespace

std::vector<std::string> SettingsFaults::in_order() const {
  std::vector<std::string> lines;
  for (const auto& [line, text] : by_line_) lines.push_back(text);
  return lines;
}

void SettingsTable::read(const std::string& key, bool& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  if (!node->is_boolean()) return wrong_type(*node, key, "true or false");
  value = *node->value<bool>();
}

void SettingsTable::read(const std::string& key, std::string& value, std::size_t longest) {
  std::string found;
  const toml::node* node = text(key, found);
  if (node == nullptr) return;
  if (found.empty() || letters_in(found) > longest || !is_printable(found)) {
    return fault(*node,
                 fmt::format("{} must have 1 to {} printable characters", full(key), longest));
  }
  value = found;
}

void SettingsTable::read(const std::string& key, double& value, double least, double most) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  if (!node->is_number()) return wrong_type(*node, key, "a number");
  const double found = node->value<double>().value_or(std::nan(""));
  if (!(found >= least && found <= most)) {
    return fault(*node, fmt::format("{} = {} is outside {} to {}", full(key), found, least, most));
  }
  value = found;
}

void SettingsTable::read(const std::string& key, std::optional<double>& value, double least,
                         double most) {
  if (!table_.contains(key)) {
    known_.push_back(key);
    return;
  }
  double found = least;
  read(key, found, least, most);
  value = found;
}

void SettingsTable::read(const std::string& key, int& value, int least, int most) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  if (!node->is_integer()) return wrong_type(*node, key, "a whole number");
  const std::int64_t found = *node->value<std::int64_t>();
  if (found < least || found > most) {
    return fault(*node, fmt::format("{} = {} is outside {} to {}", full(key), found, least, most));
  }
  value = static_cast<int>(found);
}

void SettingsTable::read(const std::string& key, std::uint64_t& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  if (!node->is_integer()) return wrong_type(*node, key, "a whole number");
  const std::int64_t found = *node->value<std::int64_t>();
  if (found < 0) return fault(*node, fmt::format("{} = {} is below 0", full(key), found));
  value = static_cast<std::uint64_t>(found);
}

void SettingsTable::read(const std::string& key, std::filesystem::path& value,
                         const std::filesystem::path& base) {
  constexpr std::size_t kLongestPath = 1024;
  std::string found;
  read(key, found, kLongestPath);
  if (!found.empty()) value = (base / found).lexically_normal();
}

std::vector<double> SettingsTable::numbers(const std::string& key, std::size_t count) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  const toml::array* list = node->as_array();
  std::vector<double> found;
  if (list != nullptr) {
    for (const auto& item : *list) {
      const auto number = item.is_number() ? item.value<double>() : std::nullopt;
      if (number && std::isfinite(*number)) found.push_back(*number);
    }
  }
  if (list != nullptr && list->size() == count && found.size() == count) return found;
  fault(*node, fmt::format("{} must be a list of {} numbers", full(key), count));
  return {};
}

std::vector<const toml::table*> SettingsTable::tables(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  const toml::array* list = node->as_array();
  if (list == nullptr || !list->is_array_of_tables()) {
    fault(*node, fmt::format("{} must be written as [[{}]], once for each", full(key), full(key)));
    return {};
  }
  std::vector<const toml::table*> found;
  for (const auto& item : *list) found.push_back(item.as_table());
  return found;
}

const toml::table* SettingsTable::table(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) {
    fault(*node, fmt::format("{} must be written as [{}]", full(key), full(key)));
  }
  return node->as_table();
}

void SettingsTable::finish() {
  for (const auto& [key, node] : table_) {
    const std::string name(key.str());
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    const std::string meant = nearest_word(name, known_);
    faults_.add(
        key.source().begin.line,
        meant.empty()
            ? fmt::format("there is no setting {}: known here are {}", full(name), quoted(known_))
            : fmt::format("there is no setting {}: did you mean {}?", full(name), full(meant)));
  }
}

void SettingsTable::fault(const toml::node& node, const std::string& text) {
  faults_.add(node.source().begin.line, text);
}

const toml::node* SettingsTable::find(const std::string& key) {
  known_.push_back(key);
  return table_.get(key);
}

const toml::node* SettingsTable::text(const std::string& key, std::string& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return nullptr;
  if (!node->is_string()) {
    wrong_type(*node, key, "text in quotes");
    return nullptr;
  }
  value = *node->value<std::string>();
  return node;
}

std::string SettingsTable::full(const std::string& key) const {
  return name_.empty() ? key : name_ + "." + key;
}

void SettingsTable::wrong_type(const toml::node& node, const std::string& key,
                               const std::string& wanted) {
  fault(node, fmt::format("{} must be {}, but it is {}", full(key), wanted, kind_of(node)));
}

void SettingsTable::not_a_choice(const toml::node& node, const std::string& key,
                                 const std::string& word, const std::vector<std::string>& names) {
  const std::string meant = nearest_word(word, names);
  fault(node, meant.empty()
                  ? fmt::format("{} = \"{}\" is not one of {}", full(key), word, quoted(names))
                  : fmt::format("{} = \"{}\" is not one of {}: did you mean \"{}\"?", full(key),
                                word, quoted(names), meant));
}

}  // namespace instep
