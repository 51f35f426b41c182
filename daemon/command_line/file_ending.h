#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace instep {

/// `ending`: in small letters, with its dot.
inline bool has_ending(const std::string& file, const std::string& ending) {
  std::string own = std::filesystem::path(file).extension();
  for (char& letter : own)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return own == ending;
}

/// For CLI::Option::check: that the name of a file to be written ends in one of `endings`, ".svg"
/// and the like, in capitals too, so that it says what the file holds.
class FileEnding {
 public:
  explicit FileEnding(std::vector<std::string> endings) : endings_(std::move(endings)) {}

  /// What is wrong with the name; empty if nothing is.
  std::string operator()(const std::string& file) const {
    const auto is_own = [&](const std::string& ending) { return has_ending(file, ending); };
    if (std::any_of(endings_.begin(), endings_.end(), is_own)) return "";
    std::string asked = endings_.front();
    for (std::size_t i = 1; i < endings_.size(); ++i) asked += " or " + endings_[i];
    return "needs a name that ends in " + asked;
  }

 private:
  std::vector<std::string> endings_;
};

}  // namespace instep
