#include "core/surface/noise/close_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/median.h"
#include "core/normal_spread.h"
#include "core/stride.h"

namespace instep {
namespace {

constexpr std::size_t kMostAsked = 2000;
/// Pairs, in spacings: nearer ones may be copies, or rounded to the same place; further ones tell
/// of the skin alone.
constexpr double kNearest = 0.02;
constexpr double kFurthest = 0.4;
constexpr std::size_t kFewestPairs = 20;
/// Pairs so near show how much noise there is, whatever slopes there are.
constexpr double kNear = 0.15;
constexpr std::size_t kFewestNear = 5;
/// Standard deviations of a rank correlation that chance hardly makes.
constexpr double kPlain = 3.0;
/// What near pairs show, against the noise in question.
constexpr double kLeastShare = 0.5;

/// How far two points are apart, and what they differ by in height.
struct Pair {
  double distance;
  double height;
};

/// Numbers of points and their nearest ones, each two once.
std::vector<std::pair<std::size_t, std::size_t>> nearest_neighbours(
    const std::vector<OrientedPoint>& points, const PointIndex& index) {
  std::vector<std::pair<std::size_t, std::size_t>> neighbours;
  const std::size_t stride = stride_to_at_most(kMostAsked, points.size());
  for (std::size_t i = 0; i < points.size(); i += stride) {
    for (const auto& neighbour : index.nearest(points[i].position, 2)) {
      neighbours.push_back(std::minmax(i, neighbour.index));
    }
  }
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  return neighbours;
}

/// In spacings.
std::vector<Pair> close_pairs(const std::vector<OrientedPoint>& points, const PointIndex& index,
                              double spacing) {
  std::vector<Pair> pairs;
  for (const auto& [i, j] : nearest_neighbours(points, index)) {
    const Eigen::Vector3d way = (points[j].position - points[i].position) / spacing;
    const double distance = way.norm();
    if (!(distance > kNearest && distance < kFurthest)) continue;
    const Eigen::Vector3d outward = 0.5 * (points[i].normal + points[j].normal);
    pairs.push_back({distance, std::abs(outward.dot(way))});
  }
  return pairs;
}

/// Of each value among all of them, less the middle one; of equal ones the mean.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
    while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
    const double mean =
        0.5 * static_cast<double>(from + to) - 0.5 * static_cast<double>(order.size());
    for (std::size_t i = from; i < to; ++i) ranks[order[i]] = mean;
  }
  return ranks;
}

/// By how many of its standard deviations pairs are the less steep the further apart they are
/// (Spearman's rank correlation). Slopes of whatever distribution do not depend on the distance.
double fall_of_slopes(const std::vector<Pair>& pairs) {
  std::vector<double> distances;
  std::vector<double> slopes;
  for (const auto& pair : pairs) {
    distances.push_back(pair.distance);
    slopes.push_back(pair.height / pair.distance);
  }
  const auto by_distance = ranks_of(distances);
  const auto by_slope = ranks_of(slopes);
  const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  const double spread = std::sqrt(product(by_distance, by_distance) * product(by_slope, by_slope));
  if (!(spread > 0.0)) return 0.0;
  return -product(by_distance, by_slope) / spread *
         std::sqrt(static_cast<double>(pairs.size() - 1));
}

/// The noise that near pairs would show if it were all; nothing of too few.
double noise_of_near(const std::vector<Pair>& pairs) {
  std::vector<double> heights;
  for (const auto& pair : pairs) {
    if (pair.distance < kNear) heights.push_back(pair.height);
  }
  if (heights.size() < kFewestNear) return 0.0;
  return kSigmaInMedians * median(std::move(heights)) / std::numbers::sqrt2;
}

}  // namespace

bool is_noise_between_pairs(const std::vector<OrientedPoint>& points, const PointIndex& index,
                            double spacing, double sigma) {
  const auto pairs = close_pairs(points, index, spacing);
  if (pairs.size() < kFewestPairs) return false;
  return noise_of_near(pairs) * spacing >= kLeastShare * sigma && fall_of_slopes(pairs) > kPlain;
}

}  // namespace instep
