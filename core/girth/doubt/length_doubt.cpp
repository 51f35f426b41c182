#include "core/girth/doubt/length_doubt.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <variant>
#include <vector>

#include "core/geometry/plane_vectors.h"
#include "core/girth/contour/contour_turns.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

/// How much unseen waves between exact points count against all else, so that intervals hold.
constexpr double kUnseenWaves = 1.25;
/// How many of the unseen waves there are, by the middle of scanned feet and lasts, where all the
/// bending of exact points is at their own scale.
constexpr double kLikelyWaves = 1.6;
/// A surface through points wanders no further between them, against the radius of a patch, however
/// rough a crease within it seems.
constexpr double kWidestWandering = 0.06;
/// Noise hides fine bends of uneven skin, of which neighbours know too little: patches narrower
/// than this (against the body) have more unseen waves than are expected by the square of how much
/// narrower they are, up to a limit, as far as the skin is uneven. Their doubt grows less and
/// later. Girths of scanned feet of 60,000 and 200,000 points with 0.02 to 0.3 mm of noise err 0.03
/// to 0.11 mm and 99 % hold; without this 0.12 to 0.21 mm and half.
constexpr double kWidthOfEvenSkin = 0.1;
constexpr double kMostFinerWaves = 4.0;
constexpr double kFinerWavesInDoubt = 1.5;
constexpr double kMostFinerDoubt = 2.0;
/// Roughness of patches under noise, the geometric mean round a section: that of simulated feet,
/// which are smooth, is below the first unless noise hides it, that of scanned ones above the
/// second.
constexpr double kSmoothSkin = 0.001;
constexpr double kUnevenSkin = 0.004;
/// Part of the expected noise waves that is left where several patches are blended.
constexpr double kBlendedNoise = 0.5;
/// More than this part of a length is no correction but a guess.
constexpr double kMostWaves = 0.001;
/// Unseen waves that lengthen a line by less than this part of it are not looked at closer.
constexpr double kLeastWaves = 1e-6;
/// Exact points tell one roughness for all directions, but bodies bend more round their girths than
/// along them: the waves of feet and lasts (900 to 17,000 points) are 1.45 to 1.9 times as many in
/// that direction, by the second derivatives of their patches.
constexpr double kBentAcross = 1.6;
/// Variance of a direction (square radians) beyond which waves would be folds.
constexpr double kSteepestWaves = 0.01;
/// What first order leaves out, against the length; of points that are exact all round.
constexpr double kLeast = 1e-5;
constexpr double kLeastOfExact = 2e-6;
/// Bends are told of as many pieces of a contour: of finer ones noise would tell more. Where a
/// piece turns more (radians) it is a crease, whose sides do not bend.
constexpr std::size_t kWindows = 40;
constexpr double kSharpestRound = 1.0;
/// A surface hardly crosses the plane where its slope on it is less.
constexpr double kLeastSlope = 0.1;

/// A part of the contour that one sheet of one patch decides.
struct Stretch {
  SurfacePatch::Sheet sheet;
  std::vector<Eigen::Vector3d> corners;
  std::vector<std::size_t> numbers;  ///< of the corners on the contour
  std::vector<double> contact;       ///< what each corner's height counts for the lengths
  std::vector<double> stretched;
  std::vector<double> slopes;  ///< heights to moves on the plane
  double length = 0.0;
};

/// Of the stretches where there is noise.
struct Unevenness {
  double length = 0.0;
  double log_roughness = 0.0;  ///< times the length

  void add(const Stretch& stretch) {
    length += stretch.length;
    log_roughness += stretch.length * std::log(stretch.sheet.patch->roughness());
  }

  /// From none of smooth skin to all of uneven.
  double part() const {
    if (!(length > 0.0)) return 0.0;
    const double over = log_roughness / length - std::log(kSmoothSkin);
    return std::clamp(over / std::log(kUnevenSkin / kSmoothSkin), 0.0, 1.0);
  }
};

/// What is gathered over the stretches.
struct Sums {
  std::vector<double> contact;  ///< influence of each point on the length
  std::vector<double> stretched;
  double contact_wandering = 0.0;  ///< variance
  double stretched_wandering = 0.0;
  double rounding = 0.0;      ///< variance
  double noise_waves = 0.0;   ///< length
  double unseen_waves = 0.0;  ///< weighed
  double likely_waves = 0.0;  ///< length, as the points hint at
  double finer_waves = 0.0;   ///< as many more if the skin is uneven
  Unevenness unevenness;
  bool is_exact = true;  ///< all that were added
};

std::vector<Stretch> stretches_of(const Contour& contour, const BlendedSurface& surface) {
  const ContourTurns turns = turns_of(contour);
  const std::size_t count = contour.points.size();
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d place(contour.points[i].x(), contour.points[i].y(), 0.0);
    const SurfacePatch* patch = surface.leading_patch(place);
    if (patch == nullptr) continue;
    const auto sheet = patch->sheet_at(place);
    auto here = std::find_if(stretches.begin(), stretches.end(),
                             [&](const Stretch& stretch) { return stretch.sheet.is_same(sheet); });
    if (here == stretches.end()) {
      stretches.push_back({sheet, {}, {}, {}, {}, {}, 0.0});
      here = std::prev(stretches.end());
    }
    Stretch& stretch = *here;
    const double slope = std::max(patch->at(place).gradient.head<2>().norm(), kLeastSlope);
    stretch.corners.push_back(place);
    stretch.numbers.push_back(i);
    stretch.contact.push_back(turns.contact[i] / slope);
    stretch.stretched.push_back(turns.stretched[i] / slope);
    stretch.slopes.push_back(slope);
    stretch.length += contour.chord(i);
  }
  return stretches;
}

/// A part of the variance by wandering that is believed. `shares`: of the corners' heights.
double likely_wandering(const Stretch& stretch, double variance,
                        const std::vector<double>& shares) {
  double turn = 0.0;
  for (const double share : shares) turn += std::abs(share);
  const double widest = kWidestWandering * stretch.sheet.owner->radius * turn;
  return std::min(variance, widest * widest);
}

/// Of a stretch's corners the first of the two that are neighbours on the contour and nearest to
/// its middle: elsewhere another patch may come between them.
std::optional<std::size_t> middle_chord(const Stretch& stretch) {
  const auto& numbers = stretch.numbers;
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i + 1 < numbers.size(); ++i) {
    if (numbers[i + 1] != numbers[i] + 1) continue;
    const auto off = [&](std::size_t at) {
      return std::abs(2.0 * static_cast<double>(at) - static_cast<double>(numbers.size() - 2));
    };
    if (!best || off(i) < off(*best)) best = i;
  }
  return best;
}

/// The sums of a stretch's heights that are asked for.
enum SumOfHeights : Eigen::Index { kContact, kStretched, kTilt };

/// What each corner's height counts for them, a column each. The tilt is that of the middle chord;
/// none if there is none.
Eigen::MatrixXd shares_of(const Stretch& stretch) {
  const auto column = [](const std::vector<double>& values) {
    return Eigen::VectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
  };
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(column(stretch.contact).size(), 3);
  shares.col(kContact) = column(stretch.contact);
  shares.col(kStretched) = column(stretch.stretched);
  const auto middle = middle_chord(stretch);
  if (!middle) return shares;
  const double step = (stretch.corners[*middle + 1] - stretch.corners[*middle]).norm();
  if (!(step > 0.0)) return shares;
  const double rise = 1.0 / (step * stretch.slopes[*middle]);
  shares.col(kTilt).segment<2>(static_cast<Eigen::Index>(*middle)) = Eigen::Vector2d(-rise, rise);
  return shares;
}

void add_unseen_between_exact(const HeightPatch& patch, double unseen, double length, Sums& sums) {
  unseen *= kBentAcross;
  sums.unseen_waves += kUnseenWaves * unseen;
  if (unseen < kLeastWaves * length) return;
  sums.likely_waves += kLikelyWaves * patch.fine_bending() * unseen;
}

void add_unseen_under_noise(const Stretch& stretch, double unseen, Sums& sums) {
  const double narrower = kWidthOfEvenSkin / stretch.sheet.owner->radius;
  const double finer = std::clamp(narrower * narrower, 1.0, kMostFinerWaves);
  sums.unseen_waves += unseen * std::clamp(finer / kFinerWavesInDoubt, 1.0, kMostFinerDoubt);
  sums.likely_waves += unseen;
  sums.finer_waves += (finer - 1.0) * unseen;
  sums.unevenness.add(stretch);
}

/// A line of that length whose direction varies by `noise` and `wandering` is longer by half of it.
void add_waves(const Stretch& stretch, double noise, double wandering, Sums& sums) {
  sums.noise_waves += 0.5 * stretch.length * std::min(noise, kSteepestWaves);
  const double unseen = 0.5 * stretch.length * std::min(wandering, kSteepestWaves);
  const auto& patch = *stretch.sheet.patch;
  if (patch.is_exact()) {
    add_unseen_between_exact(patch, unseen, stretch.length, sums);
  } else {
    add_unseen_under_noise(stretch, unseen, sums);
  }
}

void add(const Stretch& stretch, const std::vector<OrientedPoint>& points, Sums& sums) {
  const auto of_patch = stretch.sheet.patch->sums(stretch.corners, shares_of(stretch));
  double noise = 0.0;
  for (std::size_t i = 0; i < stretch.sheet.size(); ++i) {
    const auto influence = of_patch.influence.row(static_cast<Eigen::Index>(i));
    const std::size_t point = stretch.sheet.member(i);
    sums.contact[point] += influence[kContact];
    sums.stretched[point] += influence[kStretched];
    noise += influence[kTilt] * influence[kTilt] * points[point].variance;
  }
  sums.contact_wandering += likely_wandering(stretch, of_patch.variance[kContact], stretch.contact);
  sums.stretched_wandering +=
      likely_wandering(stretch, of_patch.variance[kStretched], stretch.stretched);
  add_waves(stretch, noise, of_patch.variance[kTilt], sums);
  sums.is_exact = sums.is_exact && stretch.sheet.patch->is_exact();
}

/// A patch in space knows no sums: all of its stretch may be off by as much as its middle.
double coherent_variance(const Stretch& stretch, const std::vector<double>& shares) {
  double sum = 0.0;
  for (const double share : shares) sum += share;
  return sum * sum * stretch.sheet.owner->variance;
}

/// Of a length over the creases that the contour crosses: those of which both sheets have a
/// stretch. They add up, since a body has round edges or sharp ones.
double rounding_variance(const std::vector<Stretch>& stretches) {
  double sum = 0.0;
  for (auto here = stretches.begin(); here != stretches.end(); ++here) {
    const auto* owner = here->sheet.owner;
    const bool crossed = std::any_of(stretches.begin(), here,
                                     [&](const Stretch& one) { return one.sheet.owner == owner; });
    if (crossed) sum += owner->rounding;
  }
  return sum * sum;
}

double half_width(const std::vector<double>& influence, double wandering, const Sums& sums,
                  const std::vector<OrientedPoint>& points, double length) {
  double noise = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    noise += influence[i] * influence[i] * points[i].variance;
  }
  const double variance = noise + wandering + sums.rounding +
                          sums.unseen_waves * sums.unseen_waves +
                          sums.noise_waves * sums.noise_waves;
  return kDeviations * std::sqrt(variance) + (sums.is_exact ? kLeastOfExact : kLeast) * length;
}

}  // namespace

LengthDoubt doubt_of(const Contour& contour, const BlendedSurface& surface, double sigma) {
  const auto& points = surface.points();
  Sums sums;
  sums.contact.assign(points.size(), 0.0);
  sums.stretched.assign(points.size(), 0.0);
  const auto stretches = stretches_of(contour, surface);
  sums.rounding = rounding_variance(stretches);
  for (const auto& stretch : stretches) {
    if (stretch.sheet.patch == nullptr) {
      sums.contact_wandering += coherent_variance(stretch, stretch.contact);
      sums.stretched_wandering += coherent_variance(stretch, stretch.stretched);
      const auto& field = stretch.sheet.owner->field;
      sums.is_exact = sums.is_exact && std::holds_alternative<QuinticPatch>(field);
      continue;
    }
    add(stretch, points, sums);
  }
  const double length = contour.length();
  const double most = kMostWaves * length;
  const double direction = doubt_of_direction(sigma, contour);
  const auto half_width_of = [&](const std::vector<double>& influence, double wandering) {
    return std::hypot(half_width(influence, wandering, sums, points, length), direction);
  };
  const double waves = sums.likely_waves + sums.unevenness.part() * sums.finer_waves -
                       kBlendedNoise * sums.noise_waves;
  return {std::clamp(waves, -most, most), half_width_of(sums.contact, sums.contact_wandering),
          half_width_of(sums.stretched, sums.stretched_wandering)};
}

double doubt_of_direction(double sigma, const Contour& contour) {
  const std::size_t corners = contour.points.size();
  const std::size_t windows = std::min(kWindows, corners);
  double bends = 0.0;  // the square of the bend, summed up along the line
  for (std::size_t window = 0; window < windows; ++window) {
    const std::size_t from = window * corners / windows;
    const std::size_t to = (window + 1) * corners / windows;
    double way = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      way += contour.chord(i);
    }
    const double turn = turn_between(contour.outward[from], contour.outward[to % corners]);
    bends += std::pow(std::min(std::abs(turn), kSharpestRound), 2) / way;
  }
  return sigma * sigma * bends;
}

}  // namespace instep
