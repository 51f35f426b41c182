#include "core/surface/close_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/median.h"
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
/// Standard deviations of a rank correlation that chance does not make.
constexpr double kPlain = 4.0;
/// What near pairs show, against the noise in question.
constexpr double kLeastShare = 0.5;

/// How far two points are apart, and what they differ by in height.
struct Pair {
  double distance;
  double height;
};

/// In spacings.
std::vector<Pair> close_pairs(const std::vector<OrientedPoint>& points, const PointIndex& index,
                              double spacing) {
  std::vector<Pair> pairs;
  const std::size_t stride = stride_to_at_most(kMostAsked, points.size());
  for (std::size_t i = 0; i < points.size(); i += stride) {
    for (const auto& neighbour : index.nearest(points[i].position, 2)) {
      const auto& one = points[i];
      const auto& other = points[neighbour.index];
      const double distance = std::sqrt(neighbour.squared_distance) / spacing;
      if (!(distance > kNearest && distance < kFurthest)) continue;
      const Eigen::Vector3d outward = 0.5 * (one.normal + other.normal);
      pairs.push_back({distance, std::abs(outward.dot(one.position - other.position)) / spacing});
    }
  }
  return pairs;
}

/// Of each value among all of them, less the middle one.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  const double middle = 0.5 * static_cast<double>(values.size() - 1);
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) ranks[order[i]] = static_cast<double>(i) - middle;
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
  double product = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    product += by_distance[i] * by_slope[i];
    square += by_distance[i] * by_distance[i];
  }
  return -product / square * std::sqrt(static_cast<double>(pairs.size() - 1));
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
