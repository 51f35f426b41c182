#include "core/surface/noise_estimate.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/median.h"
#include "core/surface/height_kriging.h"
#include "core/surface/kriging_likelihood.h"
#include "core/surface/local_mean.h"
#include "core/surface/quintic_patch.h"

namespace instep {
namespace {

constexpr std::size_t kNeighbourhoods = 24;
/// Every third of them is asked first: if all of those are of exact points, the others are too.
/// Variances less than this part of the square of their radius are those of exact points.
constexpr std::array<std::size_t, 3> kTurns = {1, 0, 2};
constexpr double kExactVariance = 1e-10;
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
constexpr double kPlainlyWider = 2.0;
/// Standard deviation of the logarithm of the roughness over a body: smooth and creased parts.
constexpr double kRoughnessSpread = 2.0;
constexpr double kLeastRoughness = 1e-12;
constexpr double kLeastVariance = 1e-24;
/// Ratios of noise to shape that are tried, against the kernel's own size.
constexpr double kLeastRatio = 1e-12;
constexpr double kMostRatio = 1e3;
constexpr double kRatioStep = 2.0;
/// Roughnesses that are tried, against one that explains all heights.
constexpr double kRoughest = 4.0;
constexpr double kSmoothest = 1e-8;
constexpr double kRoughnessStep = 0.5;
/// Of a neighbourhood so many points count at most, evenly chosen by their distance from its
/// middle: the work grows with their cube.
constexpr std::size_t kMostSamples = 60;
/// Terms of a quadratic in two variables: curvature is shape, not roughness.
constexpr Eigen::Index kTerms = 6;
/// A neighbourhood whose thickness is at most this part of its width is flat enough. One that is
/// not is taken larger, where noise is thicker than the spacing, or smaller, where it bends too
/// much or reaches across a thin part; the flattest counts.
constexpr double kFlatEnough = 0.15;
constexpr std::size_t kNearest = 60;
constexpr std::array<std::size_t, 3> kTriedFirst = {kNearest, 30, 20};
constexpr std::array<std::size_t, 3> kTriedThen = {120, 240, 480};
/// So many times as far as the nearest ones lie some eight times as many.
constexpr double kWider = 2.83;

/// A neighbourhood's heights in units of its radius.
struct Neighbourhood {
  std::size_t point;  ///< at its middle
  double radius;
  KrigingLikelihood likelihood;
  double variance;  ///< the noise that fits best if the roughness may be anything

  bool is_exact() const { return variance <= kExactVariance * radius * radius; }
};

/// Heights over the tangent plane: columns are points, the third row is the height.
struct TangentView {
  Eigen::Matrix3Xd points;
  double thickness = std::numeric_limits<double>::infinity();  ///< against the width

  double radius() const { return points.size() > 0 ? points.colwise().norm().maxCoeff() : 0.0; }
};

/// `nearest`: to its middle, in that order.
TangentView tangent_view(const std::vector<Eigen::Vector3d>& points,
                         std::span<const PointIndex::Neighbour> nearest) {
  TangentView view;
  const std::size_t count = std::min(nearest.size(), kMostSamples);
  view.points.resize(3, static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t chosen = nearest[i * nearest.size() / count].index;
    view.points.col(static_cast<Eigen::Index>(i)) = points[chosen];
  }
  view.points.colwise() -= view.points.rowwise().mean().eval();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(view.points * view.points.transpose());
  view.points = axes.eigenvectors().rowwise().reverse().transpose() * view.points;
  const Eigen::Vector3d spread = axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  if (spread[1] > 0.0) view.thickness = spread[0] / spread[1];
  return view;
}

/// Whether the view of so many of the nearest is flat enough, for one of the counts; the flattest
/// of those looked at goes into `best`.
bool find_flat_view(const std::vector<Eigen::Vector3d>& points,
                    std::span<const PointIndex::Neighbour> nearest,
                    std::span<const std::size_t> counts, TangentView& best) {
  for (const std::size_t count : counts) {
    TangentView view = tangent_view(points, nearest.first(std::min(count, nearest.size())));
    if (view.thickness < best.thickness) best = std::move(view);
    if (best.thickness <= kFlatEnough) return true;
  }
  return false;
}

TangentView flattest_view(const std::vector<Eigen::Vector3d>& points, const PointIndex& index,
                          const Eigen::Vector3d& centre) {
  TangentView best;
  const auto nearest = index.nearest(centre, kNearest);
  if (find_flat_view(points, nearest, kTriedFirst, best)) return best;
  // Within a radius many are found far quicker than one by one.
  const double reach = std::sqrt(nearest.back().squared_distance);
  find_flat_view(points, index.within(centre, kWider * reach), kTriedThen, best);
  return best;
}

double likeliest_variance(const KrigingLikelihood& likelihood) {
  const double scale = likelihood.mean_diagonal();
  return likelihood.likeliest_variance(kLeastRatio * scale, kMostRatio * scale, kRatioStep);
}

/// Of heights in units of `radius`.
std::optional<KrigingLikelihood> likelihood_of(const Eigen::Matrix3Xd& points, double radius) {
  const HeightSamples samples{points.topRows<2>() / radius, points.row(2).transpose() / radius,
                              Eigen::VectorXd::Ones(points.cols())};
  if (points.cols() < 2 * kTerms || !(radius > 0.0)) return std::nullopt;
  const auto kriging = HeightKriging::of(samples, kTerms);
  if (!kriging) return std::nullopt;
  return KrigingLikelihood(*kriging);
}

std::optional<Neighbourhood> neighbourhood_of(const std::vector<Eigen::Vector3d>& points,
                                              const PointIndex& index, std::size_t point) {
  const TangentView view = flattest_view(points, index, points[point]);
  const double radius = view.radius();
  auto likelihood = likelihood_of(view.points, radius);
  if (!likelihood) return std::nullopt;
  const double variance = radius * radius * likeliest_variance(*likelihood);
  return Neighbourhood{point, radius, std::move(*likelihood), variance};
}

/// The places that are asked, if all are.
std::vector<std::size_t> chosen_of(const std::vector<std::size_t>& places) {
  const std::size_t stride = std::max<std::size_t>(1, places.size() / kNeighbourhoods);
  std::vector<std::size_t> chosen;
  for (std::size_t i = stride / 2; i < places.size(); i += stride) chosen.push_back(places[i]);
  return chosen;
}

/// Of some of the places, in their order.
std::vector<Neighbourhood> neighbourhoods_of(const std::vector<Eigen::Vector3d>& points,
                                             const PointIndex& index,
                                             const std::vector<std::size_t>& places) {
  const auto chosen = chosen_of(places);
  std::vector<std::optional<Neighbourhood>> looked(chosen.size());
  bool found = false;
  bool exact = true;
  for (const std::size_t turn : kTurns) {
    for (std::size_t i = turn; i < looked.size(); i += kTurns.size()) {
      looked[i] = neighbourhood_of(points, index, chosen[i]);
      if (!looked[i]) continue;
      found = true;
      exact = exact && looked[i]->is_exact();
    }
    if (found && exact) break;
  }
  std::vector<Neighbourhood> neighbourhoods;
  for (auto& one : looked) {
    if (one) neighbourhoods.push_back(std::move(*one));
  }
  return neighbourhoods;
}

/// The roughness that fits best at a given noise; the likelihood is flat where noise hides the
/// shape, so it is held near `usual`, if that is known.
double likely_roughness(const Neighbourhood& here, double variance, std::optional<double> usual) {
  const double noise = variance / (here.radius * here.radius);
  const double level =
      std::max(here.likelihood.likeliest_roughness(kMostRatio * here.likelihood.mean_diagonal()) *
                   kMostRatio,
               1e-300);
  std::optional<KrigingLikelihood::Prior> prior;
  if (usual) prior = KrigingLikelihood::Prior{*usual * here.radius, kRoughnessSpread};
  return here.likelihood.likeliest(noise, kRoughest * level, kSmoothest * level, kRoughnessStep,
                                   prior) /
         here.radius;
}

/// By what to raise what is told, from how many times as much each neighbourhood shows.
double scale_of_told(const std::vector<double>& excesses) {
  return quantile(excesses, kFewNeighbourhoods) > kPlainlyMore ? median(excesses) : 1.0;
}

/// Each with its own noise, whatever is usual.
std::vector<double> likely_roughnesses(const std::vector<Neighbourhood>& neighbourhoods,
                                       const std::vector<double>& noise) {
  std::vector<double> likely;
  for (std::size_t i = 0; i < neighbourhoods.size(); ++i) {
    likely.push_back(likely_roughness(neighbourhoods[i], noise[i], std::nullopt));
  }
  return likely;
}

double misfit(const Neighbourhood& here, double variance, double roughness) {
  return here.likelihood.misfit(variance / (here.radius * here.radius), roughness * here.radius);
}

/// `expected`: the noise of each (a variance); `roughnesses`: those that go with it. Of those that
/// show less it is not asked how plainly where only more counts.
std::vector<NoiseWitness> witnesses_of(const std::vector<Eigen::Vector3d>& points,
                                       const std::vector<Neighbourhood>& neighbourhoods,
                                       const std::vector<double>& expected,
                                       const std::vector<double>& roughnesses, bool only_more) {
  std::vector<NoiseWitness> witnesses;
  for (std::size_t i = 0; i < neighbourhoods.size(); ++i) {
    const auto& here = neighbourhoods[i];
    const double own = std::max(here.variance, kLeastVariance);
    NoiseWitness witness{points[here.point], expected[i], own, 0.0};
    if (own > expected[i] || !only_more) {
      const double gain = misfit(here, expected[i], roughnesses[i]) -
                          misfit(here, own, likely_roughness(here, own, std::nullopt));
      witness.contradiction = std::max(gain, 0.0);
    }
    witnesses.push_back(witness);
  }
  return witnesses;
}

/// Takes their say from witnesses whose neighbourhoods are too wide.
void hush_wide(const std::vector<Neighbourhood>& neighbourhoods,
               std::vector<NoiseWitness>& witnesses) {
  for (std::size_t i = 0; i < witnesses.size(); ++i) {
    if (neighbourhoods[i].radius > kTooWideToAccuse) witnesses[i].contradiction = 0.0;
  }
}

/// Whether one polynomial passes through all points: none of them is off it by noise.
bool is_plain(const TangentView& view) {
  std::vector<OrientedPoint> points;
  for (const auto& place : view.points.colwise())
    points.push_back({place, Eigen::Vector3d::UnitZ()});
  const Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  return QuinticPatch::fit(points, middle, Eigen::Vector3d::UnitZ(), view.radius()).has_value();
}

bool is_exact(const std::vector<Eigen::Vector3d>& points, const PointIndex& index,
              std::size_t point) {
  if (is_plain(flattest_view(points, index, points[point]))) return true;
  const auto here = neighbourhood_of(points, index, point);
  return here && here->is_exact();
}

/// Nothing if the points round one show noise. Where they plainly show none half of them tell it.
std::optional<double> roughness_if_exact(const std::vector<Eigen::Vector3d>& points,
                                         const PointIndex& index, std::size_t point) {
  const TangentView view = flattest_view(points, index, points[point]);
  if (is_plain(view)) {
    const auto half = Eigen::seq(0, Eigen::last, Eigen::fix<2>);
    const auto likelihood = likelihood_of(view.points(Eigen::all, half), view.radius());
    if (!likelihood) return std::nullopt;
    const double ratio = kLeastRatio * likelihood->mean_diagonal();
    return likelihood->likeliest_roughness(ratio) / view.radius();
  }
  const auto here = neighbourhood_of(points, index, point);
  if (!here || !here->is_exact()) return std::nullopt;
  return likely_roughness(*here, std::max(here->variance, kLeastVariance), std::nullopt);
}

/// What is expected of each, in variances.
std::vector<double> expected_noise(const std::vector<Neighbourhood>& neighbourhoods,
                                   const std::vector<double>& told, const NoiseEstimate& estimate) {
  std::vector<double> variances;
  for (const auto& here : neighbourhoods) {
    const double sigma = told.empty() ? estimate.sigma : estimate.told_scale * told[here.point];
    variances.push_back(std::max(sigma * sigma, kLeastVariance));
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
bool are_outvoted(const std::vector<Neighbourhood>& neighbourhoods, double least) {
  std::vector<double> scattered;
  std::vector<double> quiet;
  for (const auto& here : neighbourhoods) {
    (here.variance > least * least ? scattered : quiet).push_back(here.radius);
  }
  if (scattered.size() < kFewestOutvoted || scattered.size() > quiet.size()) return false;
  return median(std::move(scattered)) > kPlainlyWider * median(std::move(quiet));
}

/// Of each neighbourhood: its noise (a variance) and the roughness that goes with it.
struct NoiseAndShape {
  std::vector<double> noise;
  std::vector<double> roughness;
};

/// What is used, and in `estimate` what that is against the usual.
NoiseAndShape set_noise(const std::vector<Eigen::Vector3d>& points,
                        const std::vector<Neighbourhood>& neighbourhoods,
                        const std::vector<double>& told, NoiseEstimate& estimate) {
  auto noise = expected_noise(neighbourhoods, told, estimate);
  auto roughness = likely_roughnesses(neighbourhoods, noise);
  auto witnesses = witnesses_of(points, neighbourhoods, noise, roughness, !told.empty());
  if (!told.empty()) hush_wide(neighbourhoods, witnesses);
  auto uneven = told.empty() ? uneven_noise(witnesses) : noise_beyond_told(witnesses);
  if (told.empty() && uneven.empty() && are_outvoted(neighbourhoods, least_noise(witnesses))) {
    // As if the least noise were told of all.
    const std::vector<double> least(noise.size(), std::pow(least_noise(witnesses), 2));
    uneven = noise_beyond_told(witnesses_of(points, neighbourhoods, least,
                                            likely_roughnesses(neighbourhoods, least), true));
    if (!uneven.empty()) {
      noise = least;
      estimate.sigma = least_noise(witnesses);
    }
  }
  if (uneven.empty()) return {std::move(noise), std::move(roughness)};
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] *= std::pow(uneven[i].times, 2);
  const double usual = set_uneven(std::move(uneven), estimate);
  if (!told.empty()) estimate.told_scale *= usual;
  roughness = likely_roughnesses(neighbourhoods, noise);
  return {std::move(noise), std::move(roughness)};
}

}  // namespace

NoiseEstimate estimate_noise(const std::vector<Eigen::Vector3d>& points, const PointIndex& index,
                             const std::vector<std::size_t>& places,
                             const std::vector<double>& told) {
  const auto neighbourhoods = neighbourhoods_of(points, index, places);
  std::vector<double> variances;
  std::vector<double> excesses;
  for (const auto& here : neighbourhoods) {
    variances.push_back(here.variance);
    if (!told.empty()) excesses.push_back(std::sqrt(here.variance) / told[here.point]);
  }
  NoiseEstimate estimate;
  estimate.told_scale = scale_of_told(excesses);
  if (!told.empty()) estimate.sigma = estimate.told_scale * median(told);
  if (neighbourhoods.empty()) return estimate;
  estimate.shown = std::sqrt(median(std::move(variances)));
  if (told.empty()) estimate.sigma = estimate.shown;
  auto [noise, roughness] = set_noise(points, neighbourhoods, told, estimate);
  const double usual = std::max(median(std::move(roughness)), 1e-300);
  for (std::size_t i = 0; i < neighbourhoods.size(); ++i) {
    estimate.roughness.push_back(
        {points[neighbourhoods[i].point], likely_roughness(neighbourhoods[i], noise[i], usual)});
  }
  return estimate;
}

std::optional<NoiseEstimate> estimate_if_exact(const std::vector<Eigen::Vector3d>& points,
                                               const PointIndex& index,
                                               const std::vector<std::size_t>& places) {
  const auto chosen = chosen_of(places);
  NoiseEstimate estimate;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (i % kTurns.size() == kTurns.front()) {
      const auto roughness = roughness_if_exact(points, index, chosen[i]);
      if (!roughness) return std::nullopt;
      estimate.roughness.push_back({points[chosen[i]], *roughness});
    } else if (!is_exact(points, index, chosen[i])) {
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
