#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/cases/girth_case.h"

namespace instep::test {

/// What a class of cases has to meet in its stretched lengths, mm; nothing is asked of what is not
/// given.
struct Bar {
  std::optional<double> mean_mm;   ///< of the errors' sizes
  std::optional<double> worst_mm;  ///< of the errors' sizes
  std::optional<double> bias_mm;   ///< size of the errors' mean
};

/// Cases of one kind, made when they are asked for.
struct CaseClass {
  std::string part;  ///< "rings", "shapes", ...: what a run can be limited to
  std::string name;
  Bar bar;
  std::function<std::vector<GirthCase>()> cases;
};

/// Regular rings, exact points, noise, holes: shapes whose sections are known by themselves.
std::vector<CaseClass> smooth_classes();

/// Feet of the simulated station, with no bar: their sections are known better than those of real
/// ones.
std::vector<CaseClass> simulated_foot_classes();

/// The lasts and feet of the trial data, each class with so many draws of its points and noise;
/// none where the data is absent. Means over eight draws differ from those over 64 by up to a
/// fifth.
std::vector<CaseClass> last_classes(std::uint64_t draws);
std::vector<CaseClass> foot_classes(std::uint64_t draws);

}  // namespace instep::test
