#include "core/foot/cloud/scanner_lines.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <utility>

#include "core/geometry/place_hash.h"
#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/median.h"
#include "core/picked.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kLeastPitchMm = 1.2;
constexpr double kWidestPitchMm = 15.0;  ///< feet in lines further apart are hardly feet
constexpr double kFinerPitch = 0.93;     ///< the next that is looked at, of the one before
/// Points whose nearest one is further off are in no lines: to be so much nearer is chance.
constexpr double kNearestInPitches = 1.15;
/// Points at most among which neighbours are looked for, and such as show the waves.
constexpr std::size_t kMostAsked = 200000;
constexpr std::size_t kMostOfWaves = 50000;
/// Those that tell the planes by the ways to so many of their nearest neighbours. Of noisy points
/// the nearest ones lie every way, of sparse ones those further away are on other lines.
constexpr std::size_t kAskedForWays = 1500;
constexpr std::array<std::size_t, 5> kNeighbours{2, 4, 8, 16, 32};
/// Places that tell the wave, by so many points round each.
constexpr std::size_t kAskedForWave = 80;
constexpr std::size_t kMostRoundPlace = 20;
constexpr std::size_t kFewestRoundPlace = 8;
constexpr double kRadiusInPitches = 2.5;
/// Points that hardly spread along a way are in step with every wave: the least spread (a standard
/// deviation) of those that tell, and the least share of the places at which they do.
constexpr double kLeastSpreadInPitches = 0.5;
constexpr double kFewestTelling = 0.2;
/// How well points are in step (the square of their mean turn), 1 at best and 0 at random: as well
/// as lines whose noise is a sixth of their pitch. And how well, against the best, where a wave of
/// twice the pitch is told from the best one.
constexpr double kLeastInStep = 0.35;
constexpr double kAsGood = 0.7;
constexpr double kFurtherRound = 2.0;
constexpr std::size_t kRefinements = 5;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Points round a place, as seen from it.
using Arms = std::vector<Vector3d>;

PointIndex index_of_some(const std::vector<Vector3d>& points_mm, std::size_t most) {
  return PointIndex(picked(points_mm, some_by_place(points_mm, most)));
}

/// Places that tell waves, and the points round them.
class Rounds {
 public:
  explicit Rounds(const PointIndex& index)
      : index_(index),
        places_(picked(index.points(), some_by_place(index.points(), kAskedForWave))) {}

  /// Of each place enough of those within a radius.
  std::vector<Arms> within(double radius) const {
    std::vector<Arms> rounds;
    for (const auto& place : places_) {
      const auto near = index_.around(place, radius);
      if (near.size() < kFewestRoundPlace) continue;
      const std::size_t stride = (near.size() - 1) / kMostRoundPlace + 1;
      Arms arms;
      for (std::size_t i = 0; i < near.size(); i += stride) {
        arms.push_back(index_.points()[near[i].index] - place);
      }
      rounds.push_back(std::move(arms));
    }
    return rounds;
  }

  /// How far apart points are on the surface, by those within a radius.
  double spacing(double radius) const {
    std::vector<double> spacings;
    for (const auto& place : places_) {
      spacings.push_back(spacing_within(radius, index_.around(place, radius).size()));
    }
    return median(std::move(spacings));
  }

 private:
  const PointIndex& index_;
  std::vector<Vector3d> places_;
};

/// How far some points are along a wave, in whole turns of it.
struct Phases {
  std::vector<double> turns;
  std::complex<double> mean;  ///< of the points on the unit circle that these are

  /// Nothing if they hardly spread.
  static std::optional<Phases> of(const Arms& arms, const Vector3d& wave) {
    Phases phases;
    double sum = 0.0;
    double squares = 0.0;
    for (const auto& arm : arms) {
      const double turns = wave.dot(arm);
      phases.turns.push_back(turns);
      phases.mean += std::polar(1.0, kTurn * turns);
      sum += turns;
      squares += turns * turns;
    }
    const auto count = static_cast<double>(arms.size());
    if (squares / count - std::pow(sum / count, 2) < std::pow(kLeastSpreadInPitches, 2)) {
      return std::nullopt;
    }
    phases.mean /= count;
    return phases;
  }

  /// 0 at random, on the mean.
  double in_step() const {
    const auto count = static_cast<double>(turns.size());
    return (count * std::norm(mean) - 1.0) / (count - 1.0);
  }

  /// By how much of a turn one of them is off the mean.
  double off(std::size_t i) const {
    const double off = turns[i] - std::arg(mean) / kTurn;
    return off - std::round(off);
  }
};

/// How well points are in step with a wave, at the places that tell; zero if too few do.
double in_step(const std::vector<Arms>& rounds, const Vector3d& wave) {
  double sum = 0.0;
  std::size_t telling = 0;
  for (const auto& arms : rounds) {
    const auto phases = Phases::of(arms, wave);
    if (!phases) continue;
    sum += phases->in_step();
    ++telling;
  }
  if (telling == 0) return 0.0;
  const auto told = static_cast<double>(telling);
  return told < kFewestTelling * static_cast<double>(rounds.size()) ? 0.0 : sum / told;
}

/// The ways that lead least along those to so many neighbours.
std::vector<Vector3d> ways_across(const PointIndex& index) {
  const auto& points = index.points();
  std::array<Eigen::Matrix3d, kNeighbours.size()> sums;
  sums.fill(Eigen::Matrix3d::Zero());
  for (const std::size_t asked : some_by_place(points, kAskedForWays)) {
    const auto near = index.nearest(points[asked], kNeighbours.back() + 1);
    for (std::size_t i = 1; i < near.size(); ++i) {
      const Vector3d way = (points[near[i].index] - points[asked]).normalized();
      for (std::size_t which = 0; which < sums.size(); ++which) {
        if (i <= kNeighbours[which]) sums[which] += way * way.transpose();
      }
    }
  }
  std::vector<Vector3d> ways;
  for (const auto& sum : sums) {
    ways.emplace_back(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(0));
  }
  return ways;
}

/// A wave along a way, in turns to the millimetre, and how well points are in step with it.
struct Wave {
  Vector3d turns_mm = Vector3d::UnitX();
  double in_step = 0.0;

  double pitch_mm() const { return 1.0 / turns_mm.norm(); }
};

/// As well as lines whose noise is no more than a sixth of their pitch, nor than a millimetre: of
/// two walls of a body that lie a long wave apart, points are nearly as well.
double least_in_step(double pitch_mm) {
  constexpr double kMostNoiseMm = 1.0;
  return std::max(kLeastInStep, std::exp(-std::pow(kTurn * kMostNoiseMm / pitch_mm, 2)));
}

/// All waves that are looked at, along all ways: of each way from the longest to the shortest.
std::vector<std::vector<Wave>> waves_along(const std::vector<Vector3d>& ways,
                                           const Rounds& rounds) {
  std::vector<std::vector<Wave>> waves(ways.size());
  for (double pitch = kWidestPitchMm; pitch > kFinerPitch * kLeastPitchMm; pitch *= kFinerPitch) {
    const auto some_lines = rounds.within(kRadiusInPitches * pitch);
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const Vector3d turns_mm = ways[i] / pitch;
      waves[i].push_back({turns_mm, in_step(some_lines, turns_mm)});
    }
  }
  return waves;
}

/// Points that are in step with a wave are so with one of half its length.
Wave longest_of_the_best(const std::vector<Wave>& waves) {
  const auto worse = [](const Wave& a, const Wave& b) { return a.in_step < b.in_step; };
  const double best = std::max_element(waves.begin(), waves.end(), worse)->in_step;
  if (!(best > 0.0)) return {};
  auto found = waves.begin();
  while (found->in_step < kAsGood * best) ++found;
  while (found + 1 != waves.end() && worse(*found, *(found + 1))) ++found;
  return *found;
}

/// By least squares, so that points of a round are off by no more the further they are.
Vector3d nearer(const Vector3d& wave, const std::vector<Arms>& rounds) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Vector3d products = Vector3d::Zero();
  for (const auto& arms : rounds) {
    const auto phases = Phases::of(arms, wave);
    if (!phases) continue;
    Vector3d middle = Vector3d::Zero();
    for (const auto& arm : arms) middle += arm / static_cast<double>(arms.size());
    for (std::size_t i = 0; i < arms.size(); ++i) {
      const Vector3d arm = arms[i] - middle;
      squares += arm * arm.transpose();
      products += phases->off(i) * arm;
    }
  }
  // Where no place spreads along a way, the wave is left as it is along it.
  squares.diagonal().array() += 1e-6 * squares.trace();
  return wave - squares.ldlt().solve(products);
}

/// In turns to the millimetre, as points further and further from each other tell it, for as long
/// as they are in step.
Vector3d refined(const Wave& found, const Rounds& rounds) {
  Vector3d wave = found.turns_mm;
  double radius = kRadiusInPitches * found.pitch_mm();
  for (std::size_t i = 0; i < kRefinements; ++i, radius *= kFurtherRound) {
    const auto wider = rounds.within(radius);
    if (in_step(wider, wave) < kLeastInStep) break;
    wave = nearer(wave, wider);
  }
  return wave;
}

/// Where along a wave most points are, in turns.
double phase_of(const PointIndex& index, const Vector3d& wave) {
  const auto& points = index.points();
  std::complex<double> sum;
  for (const std::size_t asked : some_by_place(points, kAskedForWays)) {
    sum += std::polar(1.0, kTurn * wave.dot(points[asked]));
  }
  return std::arg(sum) / kTurn;
}

}  // namespace

long long ScannerLines::line_of(const Vector3d& point_mm) const {
  return std::llround((across.dot(point_mm) - first_mm) / pitch_mm);
}

std::optional<ScannerLines> scanner_lines(const std::vector<Vector3d>& points_mm) {
  if (points_mm.size() <= kNeighbours.back()) return std::nullopt;
  const PointIndex close = index_of_some(points_mm, kMostAsked);
  const PointIndex apart = index_of_some(close.points(), kMostOfWaves);
  const Rounds rounds(apart);
  Wave best;
  for (const auto& waves : waves_along(ways_across(close), rounds)) {
    const Wave found = longest_of_the_best(waves);
    if (found.in_step > best.in_step) best = found;
  }
  if (!(best.in_step >= least_in_step(best.pitch_mm()))) return std::nullopt;
  const Vector3d wave = refined(best, rounds);
  ScannerLines lines{.across = wave.normalized(), .pitch_mm = 1.0 / wave.norm()};
  lines.first_mm = lines.pitch_mm * phase_of(apart, wave);
  const double spacing = rounds.spacing(kRadiusInPitches * lines.pitch_mm);
  const double taken =
      static_cast<double>(apart.points().size()) / static_cast<double>(points_mm.size());
  lines.step_mm = taken * spacing * spacing / lines.pitch_mm;
  const bool matter = lines.pitch_mm >= kLeastPitchMm &&
                      median_nearest_distance(close) < kNearestInPitches * lines.pitch_mm;
  return matter ? std::optional(lines) : std::nullopt;
}

}  // namespace instep
