#include "tests/bench/accuracy/drawn_report.h"

#include <fmt/core.h>

#include <array>
#include <cstdio>
#include <map>
#include <vector>

#include "tests/bench/accuracy/outcome_line.h"
#include "tests/bench/accuracy/report_table.h"
#include "tests/support/cases/drawn_cases.h"

namespace instep::bench {
namespace {

/// Groups in the order in which they are to be printed: by feature, then by its values.
using Groups = std::map<std::string, std::vector<test::Outcome>>;

/// The step of a ladder that a value stands on.
template <std::size_t size>
std::string range_of(double value, const std::array<double, size>& steps, const char* unit) {
  for (std::size_t i = 1; i < size; ++i) {
    if (value < steps[i]) return fmt::format("{:g} to {:g}{}", steps[i - 1], steps[i], unit);
  }
  return fmt::format("from {:g}{}", steps.back(), unit);
}

std::string noise_of(const test::CaseMaking& making) {
  constexpr std::array kSteps = {0.05, 0.1, 0.2, 0.4, 0.7, 1.0};
  return making.sigma_mm > 0.0 ? range_of(making.sigma_mm, kSteps, " mm") : " none";
}

std::string hole_of(const test::CaseMaking& making) {
  constexpr std::array kSteps = {5.0, 10.0, 15.0, 20.0, 25.0};
  return making.hole_mm > 0.0 ? fmt::format("{:>11}", range_of(making.hole_mm, kSteps, " mm"))
                              : " none";
}

std::string density_of(const test::GirthCase& drawn) {
  constexpr std::array kOfShapes = {400.0, 1000.0, 2000.0, 4000.0, 8001.0};
  constexpr std::array kOfFeet = {800.0, 2000.0, 4000.0, 8000.0, 18001.0};
  const bool whole_foot = drawn.making.body.ends_with("foot") || drawn.making.body == "last";
  const auto points = static_cast<double>(drawn.cloud.size());
  return whole_foot ? "foot or last, " + fmt::format("{:>13}", range_of(points, kOfFeet, ""))
                    : "shape, " + fmt::format("{:>13}", range_of(points, kOfShapes, ""));
}

void sort_in(const test::GirthCase& drawn, const test::Outcome& outcome, Groups& groups) {
  const auto& making = drawn.making;
  groups["body: " + making.body].push_back(outcome);
  groups["points: " + density_of(drawn)].push_back(outcome);
  groups["noise: " + noise_of(making)].push_back(outcome);
  groups["hole: " + hole_of(making)].push_back(outcome);
  groups["sampling: " + making.sampling].push_back(outcome);
  groups[std::string("normals: ") + (making.normals_told ? "told" : "not told")].push_back(outcome);
  if (making.sigma_mm > 0.0) {
    groups[std::string("sigma: ") + (making.sigma_told ? "told" : "not told")].push_back(outcome);
  }
}

/// Every girth has to have an interval, or the share says little.
void print_verdict(const char* name, const test::Held& held, int girths) {
  const double share = held.share().value_or(0.0);
  print_figure(name,
               fmt::format("{:.1f} % of {}, of {} girths", 100.0 * share, held.intervals, girths),
               "93 to 97 % of all", held.intervals == girths && share >= 0.93 && share <= 0.97);
}

}  // namespace

void report_drawn(std::uint64_t cases, bool verbose, CaseCsv& csv) {
  const test::DrawnCases draw;
  std::vector<test::Outcome> all;
  Groups groups;
  for (std::uint64_t number = 0; number < cases; ++number) {
    const auto drawn = draw(number);
    const auto outcome = test::measured(drawn);
    all.push_back(outcome);
    sort_in(drawn, outcome, groups);
    csv.add("drawn", drawn, outcome);
    if (verbose) print_outcome(drawn, outcome);
    if ((number + 1) % 100 == 0) fmt::print(stderr, "\r{} of {} drawn cases", number + 1, cases);
  }
  fmt::print(stderr, "\n");
  print_heading("drawn cases of all kinds");
  print_kind("all", test::summary_of(all));
  for (const auto& [name, outcomes] : groups) print_kind(name, test::summary_of(outcomes));
  const auto summary = test::summary_of(all);
  const int girths = summary.cases - summary.refused;
  print_verdict("95 % intervals hold, stretched", summary.stretched, girths);
  print_verdict("95 % intervals hold, contact", summary.contact, girths);
}

}  // namespace instep::bench
