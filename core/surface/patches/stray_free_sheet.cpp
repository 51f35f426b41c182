#include "core/surface/patches/stray_free_sheet.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/picked.h"

namespace instep {
namespace {

/// A point, or where points are averaged a cell of them, is odd if the others gain so much by
/// leaving it out (of twice the log likelihood). Of 216 rings and rows with half a percent of
/// points 1 to 3 mm off, 212 girths hold, and 124 with these left in.
constexpr double kGainOfStray = 30.0;
/// The first of two strays side by side gains at least so much: one hides the other.
constexpr double kGainOfOdd = 16.0;
/// Of a sheet. Looking for eight finds no more of them.
constexpr int kMostStrays = 4;
/// Points of a cell off the sheet without it by more than this part of the furthest one are off as
/// that one is.
constexpr double kAsFarOff = 0.3;

/// `numbers` without those at the positions, which ascend.
std::vector<std::size_t> without(const std::vector<std::size_t>& positions,
                                 std::vector<std::size_t> numbers) {
  for (auto position = positions.rbegin(); position != positions.rend(); ++position) {
    numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(*position));
  }
  return numbers;
}

/// The positions among `numbers` of those points of a cell that are as far off the sheet without it
/// as the furthest one; none if most are.
std::vector<std::size_t> off_unlike_most(const HeightPatch& sheet,
                                         const std::vector<std::size_t>& cell,
                                         const std::vector<std::size_t>& numbers,
                                         const std::vector<OrientedPoint>& points) {
  std::vector<double> heights;
  for (const std::size_t position : cell) {
    heights.push_back(sheet.at(points[numbers[position]].position).value);
  }
  const double furthest = *std::max_element(
      heights.begin(), heights.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  std::vector<std::size_t> off;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    if (heights[i] * furthest > kAsFarOff * furthest * furthest) off.push_back(cell[i]);
  }
  return 2 * off.size() > cell.size() ? std::vector<std::size_t>{} : off;
}

/// Of `numbers` without the odd ones, or of a cell of these without those that are off unlike most
/// of it. Nothing if there are none, or if the others tell no sheet.
std::optional<StrayFreeSheet> sheet_without(std::vector<std::size_t> odd,
                                            const std::vector<std::size_t>& numbers,
                                            const std::vector<OrientedPoint>& points,
                                            const StrayFreeSheet::FitTo& fit_to) {
  const auto fitted_without = [&]() -> std::optional<StrayFreeSheet> {
    auto fewer = without(odd, numbers);
    auto patch = fit_to(picked(points, fewer));
    if (!patch) return std::nullopt;
    return StrayFreeSheet{std::move(*patch), std::move(fewer)};
  };
  auto sheet = fitted_without();
  if (!sheet || odd.size() == 1) return sheet;
  odd = off_unlike_most(sheet->patch, odd, numbers, points);
  return odd.empty() ? std::nullopt : fitted_without();
}

}  // namespace

std::optional<StrayFreeSheet> StrayFreeSheet::of(const std::vector<OrientedPoint>& points,
                                                 const FitTo& fit_to) {
  auto all = fit_to(points);
  if (!all) return std::nullopt;
  StrayFreeSheet sheet{std::move(*all), std::vector<std::size_t>(points.size())};
  std::iota(sheet.numbers.begin(), sheet.numbers.end(), std::size_t{0});
  auto numbers = sheet.numbers;
  double gain = 0.0;
  auto odd = sheet.patch.odd_one();
  for (int round = 1; round <= kMostStrays && odd.gain > kGainOfOdd; ++round) {
    gain += odd.gain - kGainOfStray;
    auto fewer = sheet_without(std::move(odd.points), numbers, points, fit_to);
    if (!fewer) break;
    numbers = fewer->numbers;
    odd = fewer->patch.odd_one();
    if (gain <= 0.0) continue;
    gain = 0.0;
    sheet = std::move(*fewer);
  }
  return sheet;
}

}  // namespace instep
