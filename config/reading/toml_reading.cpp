#include "config/reading/toml_reading.h"

#include <set>
#include <string>

#include "config/reading/huge_numbers.h"

namespace instep {
namespace {

std::string shortened(const std::string& number) {
  constexpr std::size_t kMost = 60;
  return number.size() <= kMost ? number : number.substr(0, kMost) + "...";
}

/// False if it has to be read once more, without a number that hid the rest: a 0 is in its place,
/// in one of the lines `with_zeros`.
bool read_once(std::string& text, const std::filesystem::path& file, SettingsFaults& faults,
               std::set<unsigned>& with_zeros,
               const std::function<void(const toml::table&)>& read) {
  try {
    const toml::table toml = toml::parse(text, file.string());
    // What is wrong with a 0 is no fault of the file.
    for (const unsigned line : with_zeros) faults.pass_over(line);
    read(toml);
  } catch (const toml::parse_error& error) {
    const auto [line, column] = error.source().begin;
    const std::string fault(error.description());
    if (const auto number = take_out_huge_number(text, {line, column}, fault)) {
      faults.add(line, "no number can be as large, or as small, as " + shortened(*number) + ": " +
                           limits_of(*number));
      with_zeros.insert(line);
      return false;
    }
    faults.add(line, fault + ": write TOML, such as name = \"Bern\"");
  }
  return true;
}

}  // namespace

void read_toml(std::string_view text, const std::filesystem::path& file, SettingsFaults& faults,
               const std::function<void(const toml::table&)>& read) {
  std::string readable(text);
  std::set<unsigned> with_zeros;
  constexpr int kMostReadings = 32;  // beyond these, enough has been said
  for (int i = 0; i < kMostReadings; ++i) {
    if (read_once(readable, file, faults, with_zeros, read)) break;
  }
}

}  // namespace instep
