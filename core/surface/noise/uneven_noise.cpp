#include "core/surface/noise/uneven_noise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/median.h"
#include "core/surface/noise/local_log_mean.h"

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
/// The same where the noise is told and only places that show more have a say: of 484 drawn bodies
/// with the noise that is told, three that are measured have more; noise twice as large on a third
/// as is told gives 1.2 to 9.
constexpr double kPlainlyBeyond = 1.2;
/// Against the extent of all places: less is no noise but the texture of skin, or rounding.
constexpr double kTexture = 2e-4;
constexpr double kOutOfTexture = 3.0;
/// Standard deviation of the logarithm of the noise over a body, where it is uneven.
constexpr double kSpread = 0.7;
/// Of logarithms: half as much again. More than five times as much is no noise of a camera but two
/// layers, or strays, and lets nothing be smoothed beside it.
constexpr double kPlainStep = 0.4;
constexpr double kLargestStep = 1.7;
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
double log_ratio(const NoiseWitness& witness) {
  return 0.5 * std::log(witness.variance / witness.expected);
}

/// The diagonal of the box round all places.
double extent_of(const std::vector<NoiseWitness>& witnesses) {
  Eigen::AlignedBox3d box;
  for (const auto& witness : witnesses) box.extend(witness.place);
  return box.diagonal().norm();
}

/// Of each place the middle contradiction of its neighbours, on average.
double contradiction_of(const std::vector<NoiseWitness>& witnesses) {
  std::vector<double> deviates;
  for (const auto& witness : witnesses) {
    deviates.push_back(std::copysign(std::sqrt(witness.contradiction), log_ratio(witness)));
  }
  double sum = 0.0;
  for (const double middle : middles(deviates)) sum += std::min(middle * middle, kMostOfOnePlace);
  return sum / static_cast<double>(witnesses.size());
}

/// Its deviation is known to within itself over the square root of the contradiction.
double drawn_to_expected(double ratio, double contradiction) {
  const double prior = kSpread * kSpread * contradiction;
  return prior > 0.0 ? ratio * prior / (prior + ratio * ratio) : 0.0;
}

/// Where a noise ends between two places is not known: too little noise there leaves it in the
/// surface, too much smooths what is smooth already. So the larger one reaches over a plain step.
std::vector<double> reaching_over_steps(const std::vector<double>& ratios) {
  const std::size_t count = ratios.size();
  std::vector<double> reaching;
  for (std::size_t i = 0; i < count; ++i) {
    const double beside = std::max(ratios[(i + 1) % count], ratios[(i + count - 1) % count]);
    const double step = beside - ratios[i];
    reaching.push_back(step > kPlainStep && step < kLargestStep ? beside : ratios[i]);
  }
  return reaching;
}

std::vector<LocalNoise> noise_of_each(const std::vector<NoiseWitness>& witnesses) {
  std::vector<double> ratios;
  for (const auto& witness : witnesses) {
    ratios.push_back(drawn_to_expected(log_ratio(witness), witness.contradiction));
  }
  ratios = reaching_over_steps(middles(ratios));
  std::vector<LocalNoise> known;
  for (std::size_t i = 0; i < witnesses.size(); ++i) {
    known.push_back({witnesses[i].place, std::exp(ratios[i])});
  }
  return known;
}

}  // namespace

std::vector<LocalNoise> uneven_noise(std::vector<NoiseWitness> witnesses) {
  if (witnesses.size() < kFewestWitnesses) return {};
  const double texture = kTexture * extent_of(witnesses);
  for (auto& witness : witnesses) {
    if (!(std::sqrt(witness.expected) > texture)) return {};
    const double most = kMostTimes * kMostTimes * witness.expected;
    const double least = witness.expected / (kMostTimes * kMostTimes);
    witness.variance = std::clamp(witness.variance, least, most);
  }
  if (!(contradiction_of(witnesses) > kPlainContradiction)) return {};
  return noise_of_each(witnesses);
}

std::vector<LocalNoise> noise_beyond_told(std::vector<NoiseWitness> witnesses) {
  if (witnesses.size() < kFewestWitnesses) return {};
  const double texture = kTexture * extent_of(witnesses);
  for (auto& witness : witnesses) {
    const bool more = witness.variance > witness.expected && std::sqrt(witness.variance) > texture;
    if (more) continue;
    witness.variance = witness.expected;
    witness.contradiction = 0.0;
  }
  if (!(contradiction_of(witnesses) > kPlainlyBeyond)) return {};
  return noise_of_each(witnesses);
}

double least_noise(const std::vector<NoiseWitness>& witnesses) {
  return kOutOfTexture * kTexture * extent_of(witnesses);
}

double usual_times(const std::vector<LocalNoise>& known) {
  double squares = 0.0;
  for (const auto& local : known) squares += local.times * local.times;
  return std::sqrt(squares / static_cast<double>(known.size()));
}

double times_at(const std::vector<LocalNoise>& known, const Eigen::Vector3d& place) {
  return std::exp(
      local_log_mean(known, place, [](const LocalNoise& local) { return std::log(local.times); }));
}

}  // namespace instep
