#include "core/geometry/coordinate_step.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/stride.h"

namespace instep {
namespace {

/// Of a step, that a coordinate may be off: rounding of binary numbers.
constexpr double kOff = 0.02;
/// Numbers as near to each other, against the largest, are the same.
constexpr double kSame = 1e-12;
/// Gaps of so few steps tell the step more exactly than the smallest one, which rounding shortens.
constexpr double kShortGap = 8.0;
/// Points that are looked at first.
constexpr std::size_t kAskedFirst = 500;

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

std::vector<double> coordinates_of(const std::vector<Eigen::Vector3d>& points, Eigen::Index axis,
                                   std::size_t stride) {
  std::vector<double> coordinates;
  coordinates.reserve(points.size() / stride + 1);
  for (std::size_t i = 0; i < points.size(); i += stride) coordinates.push_back(points[i][axis]);
  return coordinates;
}

/// Whether some of the points show that the step along an axis is less, if there is one: no gap
/// is shorter than a step, but for what a step may be off, nor wider than the way between two
/// others that it lies between.
bool is_surely_less(const std::vector<Eigen::Vector3d>& points, double step) {
  double largest = 0.0;
  for (const auto& point : points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  const double differ = kSame * largest * static_cast<double>(points.size());
  const std::size_t stride = stride_to_at_most(kAskedFirst, points.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto gaps = gaps_between(coordinates_of(points, axis, stride));
    if (std::any_of(gaps.begin(), gaps.end(),
                    [&](double gap) { return gap > differ && gap < (1.0 - 2.0 * kOff) * step; })) {
      return true;
    }
  }
  return false;
}

}  // namespace

double coordinate_step(const std::vector<Eigen::Vector3d>& points) {
  std::optional<double> finest;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto step = step_of(coordinates_of(points, axis, 1));
    if (step && (!finest || *step < *finest)) finest = step;
  }
  return finest.value_or(0.0);
}

bool is_coordinate_step_over(double least, const std::vector<Eigen::Vector3d>& points) {
  return !is_surely_less(points, least) && coordinate_step(points) > least;
}

}  // namespace instep
