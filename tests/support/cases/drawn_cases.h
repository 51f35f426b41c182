#pragma once

#include <cstdint>
#include <memory>

#include "tests/support/cases/girth_case.h"

namespace instep::test {

/// Cases of all kinds, drawn at random: smooth and creased shapes, simulated and
/// scanned feet, and lasts, of any density,
/// sampling and noise, with holes, on oblique planes, with and without normals and sigma told.
/// Lasts and scanned feet come in only where the trial data is present.
class DrawnCases {
 public:
  DrawnCases();
  ~DrawnCases();

  /// The same number gives the same case.
  GirthCase operator()(std::uint64_t number) const;

 private:
  struct Bodies;
  std::unique_ptr<const Bodies> bodies_;
};

}  // namespace instep::test
