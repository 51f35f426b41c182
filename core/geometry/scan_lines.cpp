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

using Neighbours = std::vector<PointIndex::Neighbour>;

/// The second most spread of the first of some points against the most.
double thickness(const std::vector<Eigen::Vector3d>& points, const Neighbours& some,
                 std::size_t count) {
  Moments moments;
  const Eigen::Vector3d& origin = points[some.front().index];
  for (std::size_t i = 0; i < count; ++i) moments.add(points[some[i].index] - origin);
  const Eigen::Vector3d spreads = moments.axes().eigenvalues();
  return spreads[1] / spreads[2];
}

/// How many of a place's nearest, nearest first, lie on a line with it; none if they do not.
std::size_t on_a_line(const std::vector<Eigen::Vector3d>& points, const Neighbours& nearest) {
  const std::size_t most = std::min(kMost, nearest.size());
  for (std::size_t count = kFewest; count <= most; count = std::min(2 * count, most)) {
    const double thin = count == kFewest ? kThinLineOfFew : kThinLine;
    if (thickness(points, nearest, count) < thin) return count;
    if (count == most) break;
  }
  return 0;
}

std::size_t stride_of(const std::vector<Eigen::Vector3d>& points) {
  return points.size() / kAsked + 1;
}

/// Nearest first, of points in the order of their first coordinate.
Neighbours within(const std::vector<Eigen::Vector3d>& points, std::size_t place, double reach) {
  Neighbours found;
  const auto take = [&](std::size_t i) {
    const Eigen::Vector3d arm = points[i] - points[place];
    if (std::abs(arm.x()) > reach) return false;
    if (arm.squaredNorm() <= reach * reach) found.push_back({i, arm.squaredNorm()});
    return true;
  };
  for (std::size_t i = place; i < points.size() && take(i);) ++i;
  for (std::size_t i = place; i > 0 && take(i - 1);) --i;
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::tie(a.squared_distance, a.index) < std::tie(b.squared_distance, b.index);
  });
  return found;
}

/// Those within more and more, until they lie on several lines; then within so much more, since
/// where the second line is just within reach there seem to be fewer than there are.
std::optional<ScanLines> lines_round(const PointIndex& index, Neighbours nearest, double widest) {
  const auto& points = index.points();
  const Eigen::Vector3d& place = points[nearest.front().index];
  double reach = std::sqrt(nearest.back().squared_distance);
  const double step = 2.0 * reach / static_cast<double>(nearest.size());
  while (thickness(points, nearest, nearest.size()) < kSeveralLines) {
    reach *= kWidening;
    if (reach > widest) return std::nullopt;
    nearest = index.around(place, reach);
  }
  reach *= kFurtherRound;
  if (reach > widest) return std::nullopt;
  nearest = index.around(place, reach);
  const double area = std::numbers::pi * reach * reach;
  return ScanLines{step, area / static_cast<double>(nearest.size()) / step};
}

}  // namespace

bool stand_in_lines(const std::vector<Eigen::Vector3d>& points, double reach) {
  std::size_t asked = 0;
  std::size_t in_lines = 0;
  for (std::size_t i = 0; i < points.size(); i += stride_of(points)) {
    ++asked;
    if (on_a_line(points, within(points, i, reach)) > 0) ++in_lines;
  }
  return 2 * in_lines > asked;
}

std::optional<ScanLines> scan_lines(const PointIndex& index, double widest) {
  const auto& points = index.points();
  std::size_t in_lines = 0;
  std::vector<double> steps;
  std::vector<double> apart;
  for (std::size_t i = 0; i < points.size(); i += stride_of(points)) {
    auto nearest = index.nearest(points[i], kMost);
    nearest.resize(on_a_line(points, nearest));
    if (nearest.empty()) continue;
    ++in_lines;
    const auto lines = lines_round(index, std::move(nearest), widest);
    if (!lines) continue;
    steps.push_back(lines->step);
    apart.push_back(lines->apart);
  }
  if (2 * steps.size() <= in_lines || steps.empty()) return std::nullopt;
  return ScanLines{median(std::move(steps)), median(std::move(apart))};
}

}  // namespace instep
