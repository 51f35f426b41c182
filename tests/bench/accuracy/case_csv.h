#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/cases/outcome.h"

namespace instep::bench {

/// Writes a line for each case to a file, or nowhere if no file is named.
class CaseCsv {
 public:
  explicit CaseCsv(const std::filesystem::path& file);

  /// `kind`: the class, or "drawn".
  void add(const std::string& kind, const test::GirthCase& measured_case,
           const test::Outcome& outcome);

 private:
  std::ofstream file_;
};

}  // namespace instep::bench
