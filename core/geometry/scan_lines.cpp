#include "core/geometry/scan_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "core/geometry/moments.h"
#include "core/median.h"

namespace instep {
namespace {

constexpr std::size_t kAsked = 40;
/// So many of the nearest are looked at first, and so many at most: of noisy points the nearest
/// ones are no line yet.
constexpr std::size_t kFewest = 8;
constexpr std::size_t kMost = 128;
/// How far points on a line spread across it at most, against how far along it (sums of squares):
/// of a few, which may lie so by chance, and of more. And what those of several lines do at least.
constexpr double kThinLineOfFew = 0.03;
constexpr double kThinLine = 0.1;
constexpr double kSeveralLines = 0.2;
constexpr double kWidening = 1.2;
constexpr double kFurtherRound = 1.7;

/// From a place to points round it, the nearest ones first.
using Arms = std::vector<Eigen::Vector3d>;

/// The nearest first, of which lines are looked for; the others behind them.
void sort_by_length(Arms& arms) {
  const auto nearest = static_cast<std::ptrdiff_t>(std::min(kMost, arms.size()));
  std::partial_sort(arms.begin(), arms.begin() + nearest, arms.end(),
                    [](const auto& a, const auto& b) {
                      return std::tuple(a.squaredNorm(), a.x(), a.y(), a.z()) <
                             std::tuple(b.squaredNorm(), b.x(), b.y(), b.z());
                    });
}

/// The directions in which the first of some points spread, and how far.
SpreadAxes axes_of(const Arms& arms, std::size_t count) {
  Moments moments;
  for (std::size_t i = 0; i < count; ++i) moments.add(arms[i]);
  return moments.axes();
}

/// The second most spread of the first of some points against the most.
double thickness(const Arms& arms, std::size_t count) {
  const Eigen::Vector3d spreads = axes_of(arms, count).eigenvalues();
  return spreads[1] / spreads[2];
}

/// Of what lies under points on a plane: that of an ellipse with their spread, which half of it or
/// a strip, as at the end of a cloud, has within a twentieth.
double area_of(const Arms& arms) {
  const Eigen::Vector3d spreads = axes_of(arms, arms.size()).eigenvalues();
  return 4.0 * std::numbers::pi * std::sqrt(spreads[1] * spreads[2]) /
         static_cast<double>(arms.size());
}

/// How many of the nearest lie on a line; none if they do not.
std::size_t on_a_line(const Arms& arms) {
  const std::size_t most = std::min(kMost, arms.size());
  for (std::size_t count = kFewest; count <= most; count = std::min(2 * count, most)) {
    const double thin = count == kFewest ? kThinLineOfFew : kThinLine;
    if (thickness(arms, count) < thin) return count;
    if (count == most) break;
  }
  return 0;
}

std::size_t stride_of(const std::vector<Eigen::Vector3d>& points) {
  return points.size() / kAsked + 1;
}

/// Of points in the order of their first coordinate.
Arms within(const std::vector<Eigen::Vector3d>& points, std::size_t place, double reach) {
  Arms found;
  const auto take = [&](std::size_t i) {
    const Eigen::Vector3d arm = points[i] - points[place];
    if (std::abs(arm.x()) > reach) return false;
    if (arm.squaredNorm() <= reach * reach) found.push_back(arm);
    return true;
  };
  for (std::size_t i = place; i < points.size() && take(i);) ++i;
  for (std::size_t i = place; i > 0 && take(i - 1);) --i;
  sort_by_length(found);
  return found;
}

/// Points near a place, seen along the direction in which they spread least: of several noisy lines
/// that of the noise, so that lines look thin from there.
Arms flattened(const PointIndex& index, const Eigen::Vector3d& place, double reach) {
  Arms arms;
  Moments moments;
  for (const auto& one : index.around(place, reach)) {
    arms.push_back(index.points()[one.index] - place);
    moments.add(arms.back());
  }
  const Eigen::Vector3d up = moments.flattest();
  for (auto& arm : arms) arm -= up.dot(arm) * up;
  sort_by_length(arms);
  return arms;
}

/// Of those within more and more, until they lie on several lines; then counted within so much
/// more, since where the second line is just within reach there seem to be fewer than there are.
std::optional<ScanLines> lines_round(const PointIndex& index, const Eigen::Vector3d& place,
                                     double widest) {
  double reach = std::sqrt(index.nearest(place, kFewest).back().squared_distance);
  for (; reach > 0.0 && kFurtherRound * reach <= widest; reach *= kWidening) {
    const Arms arms = flattened(index, place, reach);
    if (arms.size() < kFewest || thickness(arms, arms.size()) < kSeveralLines) continue;
    const std::size_t alike = on_a_line(arms);
    if (alike == 0) continue;
    const double step = 2.0 * arms[alike - 1].norm() / static_cast<double>(alike);
    const Arms further = flattened(index, place, kFurtherRound * reach);
    return ScanLines{step, area_of(further) / static_cast<double>(further.size()) / step};
  }
  return std::nullopt;
}

double median_of(const std::vector<ScanLines>& seen, double ScanLines::*measure) {
  std::vector<double> measures;
  for (const auto& one : seen) measures.push_back(one.*measure);
  return median(std::move(measures));
}

}  // namespace

bool stand_in_lines(const std::vector<Eigen::Vector3d>& points, double reach) {
  const std::size_t stride = stride_of(points);
  const std::size_t asked = (points.size() + stride - 1) / stride;
  std::size_t in_lines = 0;
  std::size_t elsewhere = 0;
  // Until the rest can no longer change what most say.
  for (std::size_t i = 0; 2 * in_lines <= asked && 2 * elsewhere < asked; i += stride) {
    ++(on_a_line(within(points, i, reach)) > 0 ? in_lines : elsewhere);
  }
  return 2 * in_lines > asked;
}

std::optional<ScanLines> scan_lines(const PointIndex& index, double widest) {
  const auto& points = index.points();
  std::size_t asked = 0;
  std::vector<ScanLines> seen;
  for (std::size_t i = 0; i < points.size(); i += stride_of(points)) {
    ++asked;
    if (const auto lines = lines_round(index, points[i], widest)) seen.push_back(*lines);
  }
  if (2 * seen.size() <= asked) return std::nullopt;
  return ScanLines{median_of(seen, &ScanLines::step), median_of(seen, &ScanLines::apart)};
}

}  // namespace instep
