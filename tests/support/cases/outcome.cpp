#include "tests/support/cases/outcome.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "core/girth/girth.h"

namespace instep::test {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? kNoNumber : sum / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  if (values.empty()) return kNoNumber;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void count(Held& held, double error, const std::optional<double>& u95) {
  if (!u95) return;
  ++held.intervals;
  if (std::abs(error) <= *u95) ++held.held;
}

}  // namespace

Outcome measured(const GirthCase& measured_case) {
  Outcome outcome;
  const std::clock_t begin = std::clock();
  const auto girth = girth_by_rbf(measured_case.cloud, measured_case.plane);
  const std::clock_t end = std::clock();
  outcome.milliseconds = 1e3 * static_cast<double>(end - begin) / CLOCKS_PER_SEC;
  if (!girth) {
    outcome.refusal = girth.error().line();
    return outcome;
  }
  outcome.stretched_error_mm = girth->stretched_mm - measured_case.stretched_mm;
  outcome.contact_error_mm = girth->contact_mm - measured_case.contact_mm;
  outcome.stretched_u95_mm = girth->stretched_u95_mm;
  outcome.contact_u95_mm = girth->contact_u95_mm;
  outcome.sigma_mm = girth->sigma_mm;
  outcome.band_points = girth->band_points;
  outcome.floor_mm = measured_case.floor_mm;
  return outcome;
}

std::optional<double> Held::share() const {
  if (intervals == 0) return std::nullopt;
  return static_cast<double>(held) / intervals;
}

Summary summary_of(const std::vector<Outcome>& outcomes) {
  Summary summary;
  std::vector<double> errors, sizes, contact_sizes, u95s, milliseconds, squares;
  for (const auto& outcome : outcomes) {
    ++summary.cases;
    milliseconds.push_back(outcome.milliseconds);
    if (outcome.refusal) {
      ++summary.refused;
      continue;
    }
    errors.push_back(outcome.stretched_error_mm);
    sizes.push_back(std::abs(outcome.stretched_error_mm));
    contact_sizes.push_back(std::abs(outcome.contact_error_mm));
    count(summary.stretched, outcome.stretched_error_mm, outcome.stretched_u95_mm);
    count(summary.contact, outcome.contact_error_mm, outcome.contact_u95_mm);
    if (outcome.stretched_u95_mm) u95s.push_back(*outcome.stretched_u95_mm);
    if (outcome.floor_mm) squares.push_back(std::pow(sizes.back() / *outcome.floor_mm, 2));
  }
  summary.mean_mm = mean(sizes);
  summary.worst_mm = sizes.empty() ? kNoNumber : *std::max_element(sizes.begin(), sizes.end());
  summary.bias_mm = mean(errors);
  summary.contact_mean_mm = mean(contact_sizes);
  summary.median_milliseconds = median(milliseconds);
  if (!u95s.empty()) summary.median_u95_mm = median(u95s);
  if (!squares.empty()) summary.times_floor = std::sqrt(mean(squares));
  return summary;
}

bool meets(const Summary& summary, const Bar& bar) {
  const auto within = [](double value, const std::optional<double>& limit) {
    return !limit || std::abs(value) <= *limit;
  };
  return summary.cases > 0 && summary.refused == 0 && within(summary.mean_mm, bar.mean_mm) &&
         within(summary.worst_mm, bar.worst_mm) && within(summary.bias_mm, bar.bias_mm);
}

}  // namespace instep::test
