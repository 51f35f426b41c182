#pragma once

#include <toml++/toml.h>

#include <chrono>
#include <concepts>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace instep {

/// Where the faults of one settings file gather, each with its line.
class SettingsFaults {
 public:
  explicit SettingsFaults(std::string file) : file_(std::move(file)) {}

  void add(unsigned line, const std::string& text) {
    if (passed_over_.contains(line)) return;
    by_line_.emplace(line, file_ + ":" + std::to_string(line) + ": " + text);
  }

  /// All has been said of this line: later faults of it are not kept.
  void pass_over(unsigned line) { passed_over_.insert(line); }

  std::size_t count() const { return by_line_.size(); }
  std::vector<std::string> in_order() const;

 private:
  std::string file_;
  std::multimap<unsigned, std::string> by_line_;
  std::set<unsigned> passed_over_;
};

/// One table of a settings file, read field by field. A field that is absent keeps its value; one
/// that is wrong leaves a fault. finish() reports the keys that nobody asked for.
class SettingsTable {
 public:
  template <typename T>
  using Choices = std::vector<std::pair<std::string, T>>;

  SettingsTable(const toml::table& table, std::string name, SettingsFaults& faults)
      : table_(table), name_(std::move(name)), faults_(faults) {}

  void read(const std::string& key, bool& value);
  /// Printable text of one letter to `longest`, not of so many bytes.
  void read(const std::string& key, std::string& value, std::size_t longest);
  void read(const std::string& key, double& value, double least, double most);
  void read(const std::string& key, std::optional<double>& value, double least, double most);
  void read(const std::string& key, int& value, int least, int most);
  void read(const std::string& key, std::uint64_t& value);
  /// A relative path is taken from `base`.
  void read(const std::string& key, std::filesystem::path& value,
            const std::filesystem::path& base);

  /// The list of `count` finite numbers; empty if it is absent or wrong.
  std::vector<double> numbers(const std::string& key, std::size_t count);
  bool has(const std::string& key) const { return table_.contains(key); }

  template <typename Period>
  void read(const std::string& key, std::chrono::duration<std::int64_t, Period>& value, int least,
            int most) {
    int count = static_cast<int>(value.count());
    read(key, count, least, most);
    value = std::chrono::duration<std::int64_t, Period>(count);
  }

  template <typename T>
  void choose(const std::string& key, T& value, const Choices<std::type_identity_t<T>>& choices) {
    std::string word;
    const toml::node* node = text(key, word);
    if (node == nullptr) return;
    for (const auto& [name, choice] : choices) {
      if (name == word) {
        value = choice;
        return;
      }
    }
    std::vector<std::string> names;
    for (const auto& choice : choices) names.push_back(choice.first);
    not_a_choice(*node, key, word, names);
  }

  /// The tables of [[key]], each with its line; empty if there is none.
  std::vector<const toml::table*> tables(const std::string& key);
  /// The table [key]; nullptr if there is none.
  const toml::table* table(const std::string& key);

  /// A key that somebody else reads: it is no fault that it is there.
  void pass_by(const std::string& key) { known_.push_back(key); }
  /// Call when all fields have been read.
  void finish();

  void fault(const toml::node& node, const std::string& text);
  /// The key with the tables it stands in: "pedal.gpio".
  std::string full(const std::string& key) const;
  const std::string& name() const { return name_; }
  unsigned line() const { return table_.source().begin.line; }
  /// Of what the key says; of the table if it has no such key.
  unsigned line(const std::string& key) const {
    return has(key) ? table_.get(key)->source().begin.line : line();
  }

 private:
  const toml::node* find(const std::string& key);
  const toml::node* text(const std::string& key, std::string& value);
  void wrong_type(const toml::node& node, const std::string& key, const std::string& wanted);
  void not_a_choice(const toml::node& node, const std::string& key, const std::string& word,
                    const std::vector<std::string>& names);

  const toml::table& table_;
  std::string name_;
  SettingsFaults& faults_;
  std::vector<std::string> known_;
};

/// Reads the table [name] of `root` with `read_fields`, if it is there.
template <typename ReadFields>
void read_section(SettingsTable& root, const std::string& name, SettingsFaults& faults,
                  ReadFields read_fields) {
  const toml::table* found = root.table(name);
  if (found == nullptr) return;
  SettingsTable table(*found, root.full(name), faults);
  read_fields(table);
  table.finish();
}

}  // namespace instep
