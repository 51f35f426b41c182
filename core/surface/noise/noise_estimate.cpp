#include "core/surface/noise/noise_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/median.h"
#include "core/surface/heights/tangent_view.h"
#include "core/surface/noise/asked_places.h"
#include "core/surface/noise/local_log_mean.h"
#include "core/surface/noise/neighbourhood.h"

namespace instep {
namespace {

/// Every third of them is asked first: if all of those are of exact points, the others are too.
constexpr std::array<std::size_t, 3> kTurns = {1, 0, 2};
/// What is told of the points is too little where so small a share of the neighbourhoods shows less
/// than this times it. Of 679 drawn clouds whose noise is told rightly, and of those that fusion
/// makes of frames of the noise it knows, simulated or recorded, that share shows less than 1.06
/// times it; of five frames, or one, of three times that noise it shows 1.5 and 2 times as a rule.
constexpr double kFewNeighbourhoods = 0.25;
constexpr double kPlainlyMore = 1.25;
/// A neighbourhood wider than this part of the body has no say on noise beyond what is told: its
/// shape passes for noise. Of 576 clouds of simulated feet with the noise that is told, 36 were
/// not believed in places without this, nearly all of 800 points, and 2 with it.
constexpr double kTooWideToAccuse = 0.2;
constexpr std::size_t kFewestOutvoted = 4;
constexpr double kPlainlyWider = 1.5;
constexpr double kLeastRoughness = 1e-12;
constexpr double kLeastVariance = 1e-24;

/// A place, and what the points round it show.
struct Asked {
  Eigen::Vector3d place;
  bool between;          ///< AskedPlace::between
  double told_variance;  ///< of the noise of those points, on average; 0 where none is told
  Neighbourhood shown;
};

/// On average: points of several cameras may lie among each other, each with its own.
double told_variance_in(const TangentView& view, const std::vector<double>& told) {
  if (told.empty()) return 0.0;
  double sum = 0.0;
  for (const std::size_t point : view.indices) sum += told[point] * told[point];
  return sum / static_cast<double>(view.indices.size());
}

/// Of some of the places, in their order.
std::vector<Asked> asked_of(const PointIndex& index, const std::vector<std::size_t>& places,
                            const std::vector<double>& told) {
  const auto chosen = asked_places(index, places);
  std::vector<std::optional<Asked>> looked(chosen.size());
  bool found = false;
  bool exact = true;
  for (const std::size_t turn : kTurns) {
    for (std::size_t i = turn; i < looked.size(); i += kTurns.size()) {
      const auto& place = index.points()[chosen[i].point];
      const TangentView view = flattest_view(index, place);
      auto shown = neighbourhood_of(view);
      if (!shown) continue;
      found = true;
      exact = exact && shown->is_exact();
      looked[i] = Asked{place, chosen[i].between, told_variance_in(view, told), std::move(*shown)};
    }
    if (found && exact) break;
  }
  std::vector<Asked> asked;
  for (auto& one : looked) {
    if (one) asked.push_back(std::move(*one));
  }
  return asked;
}

/// Of `values`, one of each, those that tell what is usual: of the even places, unless none of them
/// could be looked at.
std::vector<double> even_among(const std::vector<double>& values, const std::vector<Asked>& asked) {
  std::vector<double> even;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!asked[i].between) even.push_back(values[i]);
  }
  return even.empty() ? values : even;
}

/// By what to raise what is told, from how many times as much each neighbourhood shows.
double scale_of_told(const std::vector<double>& excesses) {
  return quantile(excesses, kFewNeighbourhoods) > kPlainlyMore ? median(excesses) : 1.0;
}

/// Each with its own noise, whatever is usual.
std::vector<double> likely_roughnesses(const std::vector<Asked>& asked,
                                       const std::vector<double>& noise) {
  std::vector<double> likely;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    likely.push_back(asked[i].shown.likely_roughness(noise[i], std::nullopt));
  }
  return likely;
}

/// `expected`: the noise of each (a variance); `roughnesses`: those that go with it. Of those that
/// show less it is not asked how plainly where only more counts.
std::vector<NoiseWitness> witnesses_of(const std::vector<Asked>& asked,
                                       const std::vector<double>& expected,
                                       const std::vector<double>& roughnesses, bool only_more) {
  std::vector<NoiseWitness> witnesses;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const auto& here = asked[i].shown;
    const double own = std::max(here.variance, kLeastVariance);
    NoiseWitness witness{asked[i].place, expected[i], own, 0.0};
    if (own > expected[i] || !only_more) {
      const double gain = here.misfit(expected[i], roughnesses[i]) -
                          here.misfit(own, here.likely_roughness(own, std::nullopt));
      witness.contradiction = std::max(gain, 0.0);
    }
    witnesses.push_back(witness);
  }
  return witnesses;
}

/// Takes their say from witnesses whose neighbourhoods are too wide.
void hush_wide(const std::vector<Asked>& asked, std::vector<NoiseWitness>& witnesses) {
  for (std::size_t i = 0; i < witnesses.size(); ++i) {
    if (asked[i].shown.radius > kTooWideToAccuse) witnesses[i].contradiction = 0.0;
  }
}

bool is_exact(const PointIndex& index, const Eigen::Vector3d& place) {
  const TangentView view = flattest_view(index, place);
  if (is_plain(view)) return true;
  const auto here = neighbourhood_of(view);
  return here && here->is_exact();
}

/// Nothing if the points round a place show noise. Where they plainly show none half of them tell
/// it.
std::optional<double> roughness_if_exact(const PointIndex& index, const Eigen::Vector3d& place) {
  const TangentView view = flattest_view(index, place);
  if (is_plain(view)) return roughness_of_plain(view);
  const auto here = neighbourhood_of(view);
  if (!here || !here->is_exact()) return std::nullopt;
  return here->likely_roughness(std::max(here->variance, kLeastVariance), std::nullopt);
}

/// What is expected of each, in variances.
std::vector<double> expected_noise(const std::vector<Asked>& asked, bool is_told,
                                   const NoiseEstimate& estimate) {
  std::vector<double> variances;
  for (const auto& one : asked) {
    const double variance = is_told ? std::pow(estimate.told_scale, 2) * one.told_variance
                                    : std::pow(estimate.sigma, 2);
    variances.push_back(std::max(variance, kLeastVariance));
  }
  return variances;
}

/// From what each place has against what is expected, the usual noise and what it has against that.
/// Returns how many times the expected one the usual one is.
double set_uneven(std::vector<LocalNoise> known, NoiseEstimate& estimate) {
  const double usual = usual_times(known);
  for (auto& local : known) local.times /= usual;
  estimate.sigma *= usual;
  estimate.uneven = std::move(known);
  return usual;
}

/// Whether some neighbourhoods scatter by more than `least`, a standard deviation, and are fewer
/// than the others only because these have most of the points: they are plainly wider. Where exact
/// points seem to scatter, round creases of sparse bodies, they are not.
bool are_outvoted(const std::vector<Asked>& asked, double least) {
  std::vector<double> scattered;
  std::vector<double> quiet;
  for (const auto& one : asked) {
    const bool is_quiet = one.shown.variance <= least * least;
    (is_quiet ? quiet : scattered).push_back(one.shown.radius);
  }
  if (scattered.size() < kFewestOutvoted || scattered.size() > quiet.size()) return false;
  return median(std::move(scattered)) > kPlainlyWider * median(std::move(quiet));
}

/// Of each neighbourhood: its noise (a variance) and the roughness that goes with it.
struct NoiseAndShape {
  std::vector<double> noise;
  std::vector<double> roughness;
};

/// The noise of each place, where one for all plainly will not do. `here`: as expected; the noise
/// that the answer is against afterwards.
std::vector<LocalNoise> uneven_among(const std::vector<Asked>& asked,
                                     const std::vector<double>& told, NoiseAndShape& here,
                                     NoiseEstimate& estimate) {
  auto witnesses = witnesses_of(asked, here.noise, here.roughness, !told.empty());
  if (!told.empty()) {
    hush_wide(asked, witnesses);
    return noise_beyond_told(witnesses);
  }
  auto uneven = uneven_noise(witnesses);
  const double least = least_noise(witnesses);
  if (!uneven.empty() || !are_outvoted(asked, least)) return uneven;
  // As if the least noise were told of all.
  const std::vector<double> noise(here.noise.size(), least * least);
  uneven = noise_beyond_told(witnesses_of(asked, noise, likely_roughnesses(asked, noise), true));
  if (!uneven.empty()) {
    here.noise = noise;
    estimate.sigma = least;
  }
  return uneven;
}

/// What is used, and in `estimate` what that is against the usual.
NoiseAndShape set_noise(const PointIndex& index, const std::vector<std::size_t>& places,
                        const std::vector<Asked>& asked, const std::vector<double>& told,
                        NoiseEstimate& estimate) {
  NoiseAndShape here{expected_noise(asked, !told.empty(), estimate), {}};
  here.roughness = likely_roughnesses(asked, here.noise);
  auto uneven = uneven_among(asked, told, here, estimate);
  if (told.empty()) {
    estimate.scattered = scattered_places(index, places, estimate.shown);
  }
  if (uneven.empty() && estimate.scattered.empty()) return here;
  if (!uneven.empty()) {
    for (std::size_t i = 0; i < here.noise.size(); ++i) {
      here.noise[i] *= std::pow(uneven[i].times, 2);
    }
    const double usual = set_uneven(std::move(uneven), estimate);
    if (!told.empty()) estimate.told_scale *= usual;
  }
  for (std::size_t i = 0; i < here.noise.size(); ++i) {
    const double scatter = scatter_at(estimate.scattered, asked[i].place);
    here.noise[i] = std::max(here.noise[i], scatter * scatter);
  }
  here.roughness = likely_roughnesses(asked, here.noise);
  return here;
}

/// The middle one of the even places; zero if none could be looked at.
double noise_shown_by(const std::vector<Asked>& asked) {
  std::vector<double> variances;
  for (const auto& one : asked) variances.push_back(one.shown.variance);
  return std::sqrt(median(even_among(variances, asked)));
}

}  // namespace

double shown_noise(const PointIndex& index, const std::vector<std::size_t>& places) {
  return noise_shown_by(asked_of(index, places, {}));
}

NoiseEstimate estimate_noise(const PointIndex& index, const std::vector<std::size_t>& places,
                             const std::vector<double>& told) {
  const auto asked = asked_of(index, places, told);
  std::vector<double> excesses;
  for (const auto& one : asked) {
    if (!told.empty()) excesses.push_back(std::sqrt(one.shown.variance / one.told_variance));
  }
  NoiseEstimate estimate;
  estimate.told_scale = scale_of_told(even_among(excesses, asked));
  if (!told.empty()) estimate.sigma = estimate.told_scale * median(told);
  if (asked.empty()) return estimate;
  estimate.shown = noise_shown_by(asked);
  if (told.empty()) estimate.sigma = estimate.shown;
  auto [noise, roughness] = set_noise(index, places, asked, told, estimate);
  const double usual = std::max(median(even_among(roughness, asked)), 1e-300);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    estimate.roughness.push_back(
        {asked[i].place, asked[i].shown.likely_roughness(noise[i], usual)});
  }
  return estimate;
}

std::optional<NoiseEstimate> estimate_if_exact(const PointIndex& index,
                                               const std::vector<std::size_t>& places) {
  const auto chosen = asked_places(index, places);
  NoiseEstimate estimate;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const auto& place = index.points()[chosen[i].point];
    if (i % kTurns.size() == kTurns.front()) {
      const auto roughness = roughness_if_exact(index, place);
      if (!roughness) return std::nullopt;
      estimate.roughness.push_back({place, *roughness});
    } else if (!is_exact(index, place)) {
      return std::nullopt;
    }
  }
  if (estimate.roughness.empty()) return std::nullopt;
  return estimate;
}

double roughness_at(const std::vector<LocalRoughness>& known, const Eigen::Vector3d& place) {
  if (known.empty()) return kLeastRoughness;
  return std::exp(local_log_mean(known, place, [](const LocalRoughness& local) {
    return std::log(std::max(local.roughness, kLeastRoughness));
  }));
}

}  // namespace instep
