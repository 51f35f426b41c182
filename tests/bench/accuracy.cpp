// The errors of girth_by_rbf() over cases whose girths are known, beside what they have to meet.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "tests/bench/accuracy/case_csv.h"
#include "tests/bench/accuracy/drawn_report.h"
#include "tests/bench/accuracy/error_plots.h"
#include "tests/bench/accuracy/outcome_line.h"
#include "tests/bench/accuracy/report_table.h"
#include "tests/support/cases/case_classes.h"

namespace instep::bench {
namespace {

struct Wishes {
  std::vector<std::string> parts;
  bool verbose = false;
  std::uint64_t drawn = 2000;
  std::uint64_t draws = 32;
  std::string csv;

  bool wants(const std::string& part) const {
    return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
  }
};

std::vector<test::CaseClass> all_classes(std::uint64_t draws) {
  auto classes = test::smooth_classes();
  for (auto& foot : test::simulated_foot_classes()) classes.push_back(std::move(foot));
  for (auto& last : test::last_classes(draws)) classes.push_back(std::move(last));
  for (auto& foot : test::foot_classes(draws)) classes.push_back(std::move(foot));
  return classes;
}

std::vector<test::Outcome> measure(const test::CaseClass& chosen, bool verbose, CaseCsv& csv) {
  std::vector<test::Outcome> outcomes;
  for (const auto& one : chosen.cases()) {
    outcomes.push_back(test::measured(one));
    csv.add(chosen.name, one, outcomes.back());
    if (verbose) print_outcome(one, outcomes.back());
  }
  return outcomes;
}

void report_floor(const std::vector<test::Outcome>& outcomes) {
  constexpr double kMostTimesFloor = 1.3;
  const auto times = test::summary_of(outcomes).times_floor;
  if (!times) return;
  print_figure("error over the floor of white noise",
               fmt::format("{:.2f} times (root mean square)", *times),
               fmt::format("at most {} times", kMostTimesFloor), *times <= kMostTimesFloor);
}

void report(const Wishes& wishes) {
  CaseCsv csv(wishes.csv);
  std::vector<test::Outcome> noisy;
  bool headed = false;
  for (const auto& chosen : all_classes(wishes.draws)) {
    if (!wishes.wants(chosen.part)) continue;
    if (!headed) print_heading("classes");
    headed = true;
    const auto outcomes = measure(chosen, wishes.verbose, csv);
    print_class(chosen.name, chosen.bar, test::summary_of(outcomes));
    if (chosen.part == "noise") noisy.insert(noisy.end(), outcomes.begin(), outcomes.end());
  }
  report_floor(noisy);
  if (wishes.wants("drawn") && wishes.drawn > 0) report_drawn(wishes.drawn, wishes.verbose, csv);
}

}  // namespace
}  // namespace instep::bench

int main(int count, char** words) {
  CLI::App app("Errors of the girth by rbf over cases whose girths are known");
  instep::bench::Wishes wishes;
  app.add_option("parts", wishes.parts,
                 "Only these: rings shapes noise holes simulated lasts feet drawn")
      ->check(CLI::IsMember(
          {"rings", "shapes", "noise", "holes", "simulated", "lasts", "feet", "drawn"}));
  app.add_flag("-v,--verbose", wishes.verbose, "Print each case");
  app.add_option("--cases", wishes.drawn, "How many cases to draw")->capture_default_str();
  app.add_option("--draws", wishes.draws,
                 "How often to draw the points and noise of each last and scanned foot")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  std::string plots;
  app.add_option("--plots", plots, "Only draw the plots, as SVG files in this folder");
  app.add_option("--csv", wishes.csv, "Write a line for each case to this file");
  CLI11_PARSE(app, count, words);
  if (plots.empty()) {
    instep::bench::report(wishes);
  } else {
    instep::bench::write_error_plots(plots);
  }
  return 0;
}
