#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace instep {

/// For CLI::Option::check: that the name of a file to be written ends in one of `endings`, ".svg"
/// and the like, so that it says what the file holds.
class FileEnding {
 public:
  explicit FileEnding(std::vector<std::string> endings) : endings_(std::move(endings)) {}

  /// What is wrong with the name; empty if nothing is.
  std::string operator()(const std::string& file) const {
    const auto own = std::filesystem::path(file).extension();
    if (std::find(endings_.begin(), endings_.end(), own) != endings_.end()) return "";
    std::string asked = endings_.front();
    for (std::size_t i = 1; i < endings_.size(); ++i) asked += " or " + endings_[i];
    return "needs a name that ends in " + asked;
  }

 private:
  std::vector<std::string> endings_;
};

}  // namespace instep
