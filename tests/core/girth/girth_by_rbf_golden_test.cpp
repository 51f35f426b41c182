#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/support/cases/case_classes.h"
#include "tests/support/cases/drawn_cases.h"
#include "tests/support/cases/outcome.h"

namespace instep {
namespace {

using test::Bar;

/// What a class of the report `tests/bench/accuracy` must not exceed, mm: its bar where that is
/// met, else somewhat more than what was measured, so that it can only become better.
struct Golden {
  std::string part;
  std::string name;
  Bar bound;
};

void PrintTo(const Golden& golden, std::ostream* out) {
  *out << golden.name;
}

Golden golden(const char* part, const char* name, std::optional<double> mean,
              std::optional<double> worst, std::optional<double> bias = {}) {
  return {part, name, {.mean_mm = mean, .worst_mm = worst, .bias_mm = bias}};
}

std::vector<Golden> goldens() {
  return {
      golden("rings", "cylinder of 10 rings of 120", {}, 0.001),
      golden("rings", "cylinder of 15 rings of 60", {}, 0.001),
      golden("rings", "cylinder of 15 rings of 30", {}, 0.001),
      golden("shapes", "exact shapes, 6000 points", {}, 0.0002),
      golden("shapes", "exact shapes, 1500 points", {}, 0.002),
      golden("shapes", "exact shapes, 450 points", {}, 0.03),
      golden("noise", "noise of 0.2 mm, 8000 points", {}, 0.08, 0.01),
      golden("noise", "noise of 0.5 mm, 8000 points", {}, 0.2, 0.025),
      golden("noise", "noise of 1.0 mm, 8000 points", {}, 0.4, 0.05),
      golden("holes", "hole of 20 mm, 4000 points", {}, 0.02),
      golden("simulated", "simulated feet, 4260 points", 0.03, 0.08),
      golden("simulated", "simulated feet, 1080 points", 0.15, 0.6),
      golden("simulated", "simulated feet, 4260 points, 0.5 mm", 0.45, {}),
      golden("simulated", "simulated feet, 1080 points, 0.5 mm", 1.2, {}),
      golden("lasts", "lasts, 14240 points", 0.2, 0.6),
      golden("lasts", "lasts, 3560 points", 0.3, 1.0),
      golden("lasts", "lasts, 902 even points", 0.65, 3.0),
      golden("lasts", "lasts, 902 points", 1.1, 4.5),
      golden("lasts", "lasts, 14240 points, 0.5 mm", 0.6, {}),
      golden("lasts", "lasts, 14240 points, bare", 0.2, 0.6),
      golden("lasts", "lasts, 3560 points, bare", 0.2, 1.0),
      golden("lasts", "lasts, 902 points, bare", 1.0, 4.0),
      golden("lasts", "lasts, 3560 even points, bare", 0.15, 0.8),
      golden("lasts", "lasts, 902 even points, bare", 0.5, 2.5),
      golden("feet", "feet, 4260 points", 0.2, 0.8),
      golden("feet", "feet, 1080 points", 0.45, 2.0),
      golden("feet", "feet, 4260 points, 0.5 mm", 0.6, {}),
      golden("feet", "feet, 1080 points, 0.5 mm", 1.2, {}),
  };
}

/// Few, for the time they take: the bounds allow for chance.
constexpr std::uint64_t kDraws = 8;

std::vector<test::CaseClass> classes_of(const std::string& part) {
  if (part == "lasts") return test::last_classes(kDraws);
  if (part == "feet") return test::foot_classes(kDraws);
  return part == "simulated" ? test::simulated_foot_classes() : test::smooth_classes();
}

class GirthByRbfGolden : public ::testing::TestWithParam<Golden> {};

TEST_P(GirthByRbfGolden, KeepsItsBounds) {
  const Golden& expected = GetParam();
  const auto classes = classes_of(expected.part);
  if (classes.empty()) GTEST_SKIP() << "no trial data here";
  const auto found = std::find_if(classes.begin(), classes.end(), [&](const auto& candidate) {
    return candidate.name == expected.name;
  });
  ASSERT_NE(found, classes.end()) << "no class is called " << expected.name;
  std::vector<test::Outcome> outcomes;
  for (const auto& one : found->cases()) {
    outcomes.push_back(test::measured(one));
    EXPECT_FALSE(outcomes.back().refusal) << one.name << ": " << *outcomes.back().refusal;
  }
  const auto summary = test::summary_of(outcomes);
  EXPECT_TRUE(test::meets(summary, expected.bound))
      << "mean " << summary.mean_mm << ", worst " << summary.worst_mm << ", bias "
      << summary.bias_mm;
}

/// A test's name has letters and digits only.
std::string test_name(const ::testing::TestParamInfo<Golden>& info) {
  std::string name;
  bool starts_word = true;
  for (const char letter : info.param.name) {
    const bool counts = std::isalnum(static_cast<unsigned char>(letter)) != 0;
    if (counts) {
      name += starts_word ? static_cast<char>(std::toupper(static_cast<unsigned char>(letter)))
                          : letter;
    } else if (letter == '.') {
      name += '_';
    }
    starts_word = !counts;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Classes, GirthByRbfGolden, ::testing::ValuesIn(goldens()), test_name);

/// Of a sparse noisy foot a contour folded over half of its length; its hull was 63 mm short, with
/// an interval of 9.
TEST(FoldedContours, AreRefusedOrHold) {
  const auto outcome = test::measured(test::DrawnCases()(348));
  if (outcome.refusal) return;
  EXPECT_LE(std::abs(outcome.stretched_error_mm), *outcome.stretched_u95_mm);
  EXPECT_LE(std::abs(outcome.contact_error_mm), *outcome.contact_u95_mm);
}

}  // namespace
}  // namespace instep
