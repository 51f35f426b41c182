#include "core/surface/uneven_noise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/median.h"
#include "core/surface/local_mean.h"

namespace instep {
namespace {

constexpr std::size_t kFewestWitnesses = 8;
/// So many neighbours to each side.
constexpr std::size_t kNeighbours = 3;
/// Contradictions on average over the places, of each the middle one of its neighbours and up to
/// the most of one place. Of 1,000 drawn bodies with even noise (tests/bench/accuracy) 99 in 100 of
/// those of 1,500 points or more have at most 1.5; noise twice as large on a half or a third of a
/// body as on the rest gives 4 to 10.
constexpr double kPlainContradiction = 2.5;
constexpr double kMostOfOnePlace = 20.0;
/// Against the extent of all places: less is no noise but the texture of skin, or rounding.
constexpr double kTexture = 2e-4;
/// Standard deviation of the logarithm of the noise over a body, where it is uneven.
constexpr double kSpread = 0.7;
/// No place scatters so many times as much as usual, or as little: a zero is a guess.
constexpr double kMostTimes = 10.0;

/// Of a closed row, each place's middle one of its neighbours and itself: steps stay steps.
std::vector<double> middles(const std::vector<double>& row) {
  const std::size_t count = row.size();
  std::vector<double> smooth;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> near;
    for (std::size_t k = 0; k <= 2 * kNeighbours; ++k) {
      near.push_back(row[(i + count + k - kNeighbours) % count]);
    }
    smooth.push_back(median(std::move(near)));
  }
  return smooth;
}

/// Half the logarithm of the ratio of variances.
double log_ratio(const NoiseWitness& witness, double common) {
  const double most = std::log(kMostTimes);
  const double least = common / (kMostTimes * kMostTimes);
  return std::min(0.5 * std::log(std::max(witness.variance, least) / common), most);
}

/// The diagonal of the box round all places.
double extent_of(const std::vector<NoiseWitness>& witnesses) {
  Eigen::AlignedBox3d box;
  for (const auto& witness : witnesses) box.extend(witness.place);
  return box.diagonal().norm();
}

bool is_plain(const std::vector<NoiseWitness>& witnesses, double common) {
  std::vector<double> deviates;
  for (const auto& witness : witnesses) {
    deviates.push_back(std::copysign(std::sqrt(witness.contradiction), log_ratio(witness, common)));
  }
  double sum = 0.0;
  for (const double middle : middles(deviates)) sum += std::min(middle * middle, kMostOfOnePlace);
  return sum > kPlainContradiction * static_cast<double>(witnesses.size());
}

/// Its deviation is known to within itself over the square root of the contradiction.
double drawn_to_common(double ratio, double contradiction) {
  const double prior = kSpread * kSpread * contradiction;
  return prior > 0.0 ? ratio * prior / (prior + ratio * ratio) : 0.0;
}

}  // namespace

std::vector<LocalSigma> uneven_noise(const std::vector<NoiseWitness>& witnesses, double common) {
  if (witnesses.size() < kFewestWitnesses) return {};
  if (!(std::sqrt(common) > kTexture * extent_of(witnesses))) return {};
  if (!is_plain(witnesses, common)) return {};
  std::vector<double> ratios;
  for (const auto& witness : witnesses) {
    ratios.push_back(drawn_to_common(log_ratio(witness, common), witness.contradiction));
  }
  ratios = middles(ratios);
  std::vector<LocalSigma> sigmas;
  for (std::size_t i = 0; i < witnesses.size(); ++i) {
    sigmas.push_back({witnesses[i].place, std::sqrt(common) * std::exp(ratios[i])});
  }
  return sigmas;
}

double sigma_at(const std::vector<LocalSigma>& known, const Eigen::Vector3d& place) {
  return std::exp(
      local_log_mean(known, place, [](const LocalSigma& local) { return std::log(local.sigma); }));
}

}  // namespace instep
