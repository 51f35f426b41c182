#include "core/repeatability.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace instep {
namespace {

/// In sorted order, the value at place i is added i times and taken off n - 1 - i times.
double mean_absolute_difference(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    // From the least one: large values with small differences keep their digits.
    sum += (2.0 * static_cast<double>(i) - count + 1.0) * (values[i] - values.front());
  }
  return sum / (count * (count - 1.0) / 2.0);
}

}  // namespace

Repeatability repeatability(std::vector<double> values) {
  Repeatability figures;
  const auto count = static_cast<double>(values.size());
  figures.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : values) squares += (value - figures.mean) * (value - figures.mean);
  figures.standard_deviation = std::sqrt(squares / (count - 1.0));
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  figures.least = *least;
  figures.greatest = *greatest;
  figures.mean_absolute_difference = mean_absolute_difference(values);
  figures.values = std::move(values);
  return figures;
}

}  // namespace instep
