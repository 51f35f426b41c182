#include "core/surface/close_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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
/// Of pairs that differ by more than so many robust deviations, as over an edge or to a stray.
constexpr double kFarOff = 5.0;
/// Constants that are tried, against what slopes make of one spacing; the least stands for none.
constexpr double kLeastRatio = 1e-6;
constexpr double kMostRatio = 1e2;
constexpr double kRatioStep = 1.5;
/// Of twice the log likelihood.
constexpr double kPlainGain = 8.0;
/// The constant, a standard deviation, against the noise in question.
constexpr double kLeastShare = 0.5;

/// What two points differ by in height, squared and halved, and their distance squared.
struct Pair {
  double height;
  double distance;
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
      const double height = outward.dot(one.position - other.position) / spacing;
      pairs.push_back({0.5 * height * height, distance * distance});
    }
  }
  return pairs;
}

void drop_far_off(std::vector<Pair>& pairs) {
  std::vector<double> heights;
  for (const auto& pair : pairs) heights.push_back(std::sqrt(pair.height));
  const double most = kFarOff * kSigmaInMedians * median(std::move(heights));
  std::erase_if(pairs, [&](const Pair& pair) { return pair.height > most * most; });
}

/// Variances of the heights: of slopes over one spacing, and how likely all are so.
struct Variogram {
  double slopes = 0.0;
  double misfit = 0.0;  ///< twice the negative log likelihood
};

Variogram variogram_of(const std::vector<Pair>& pairs, double ratio) {
  const auto count = static_cast<double>(pairs.size());
  Variogram variogram;
  for (const auto& pair : pairs) {
    variogram.slopes += pair.height / (ratio + pair.distance) / count;
    variogram.misfit += std::log(ratio + pair.distance);
  }
  variogram.misfit += count * std::log(variogram.slopes);
  return variogram;
}

}  // namespace

bool is_noise_between_pairs(const std::vector<OrientedPoint>& points, const PointIndex& index,
                            double spacing, double sigma) {
  auto pairs = close_pairs(points, index, spacing);
  if (pairs.size() < kFewestPairs) return false;
  drop_far_off(pairs);
  const Variogram without = variogram_of(pairs, kLeastRatio);
  double likeliest = 0.0;
  Variogram best = without;
  for (double ratio = kLeastRatio; ratio < kMostRatio; ratio *= kRatioStep) {
    const Variogram here = variogram_of(pairs, ratio);
    if (!(here.misfit < best.misfit)) continue;
    best = here;
    likeliest = ratio;
  }
  const double shown = std::sqrt(likeliest * best.slopes) * spacing;
  return without.misfit - best.misfit > kPlainGain && shown >= kLeastShare * sigma;
}

}  // namespace instep
