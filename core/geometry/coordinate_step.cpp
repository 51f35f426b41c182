#include "core/geometry/coordinate_step.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace instep {
namespace {

/// Of a step, that a coordinate may be off: rounding of binary numbers.
constexpr double kOff = 0.02;
/// Numbers as near to each other, against the largest, are the same.
constexpr double kSame = 1e-12;
/// Gaps of so few steps tell the step more exactly than the smallest one, which rounding shortens.
constexpr double kShortGap = 8.0;

/// Between one coordinate and the next, where they differ.
std::vector<double> gaps_between(std::vector<double> coordinates) {
  std::vector<double> gaps;
  if (coordinates.empty()) return gaps;
  std::sort(coordinates.begin(), coordinates.end());
  const double largest = std::max(std::abs(coordinates.front()), std::abs(coordinates.back()));
  for (std::size_t i = 1; i < coordinates.size(); ++i) {
    const double gap = coordinates[i] - coordinates[i - 1];
    if (gap > kSame * largest) gaps.push_back(gap);
  }
  return gaps;
}

double mean_step(const std::vector<double>& gaps, double smallest) {
  double way = 0.0;
  double steps = 0.0;
  for (const double gap : gaps) {
    if (gap > kShortGap * smallest) continue;
    way += gap;
    steps += std::round(gap / smallest);
  }
  return way / steps;
}

/// Nothing of one coordinate only; zero where there is no step.
std::optional<double> step_of(std::vector<double> coordinates) {
  const auto gaps = gaps_between(std::move(coordinates));
  if (gaps.empty()) return std::nullopt;
  const double step = mean_step(gaps, *std::min_element(gaps.begin(), gaps.end()));
  const bool is_step = std::all_of(gaps.begin(), gaps.end(), [&](double gap) {
    return std::abs(gap / step - std::round(gap / step)) <= kOff;
  });
  return is_step ? step : 0.0;
}

}  // namespace

double coordinate_step(const std::vector<Eigen::Vector3d>& points) {
  std::optional<double> finest;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    along.reserve(points.size());
    for (const auto& point : points) along.push_back(point[axis]);
    const auto step = step_of(std::move(along));
    if (step && (!finest || *step < *finest)) finest = step;
  }
  return finest.value_or(0.0);
}

}  // namespace instep
