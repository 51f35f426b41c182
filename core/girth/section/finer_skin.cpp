#include "core/girth/section/finer_skin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/geometry/coordinate_step.h"
#include "core/girth/section/section_evidence.h"
#include "core/median.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

/// Of the whole line.
constexpr std::ptrdiff_t kRows = 1600;
/// In rows: heights further apart are compared, up to a wave of the longest.
constexpr std::ptrdiff_t kNearest = 2;
constexpr double kLongestWave = 96.0;
constexpr double kShortestWave = 8.0;
constexpr double kShorter = 0.87;
/// In standard deviations of what noise would share. Of 3,000 drawn ribbons of uneven noise alone
/// one has more, of the girths of 1,200 noisy cylinders none.
constexpr double kSure = 5.0;
/// The same of places on the same side of waves: where a surface follows the noise, places further
/// off lie on the other side, and these share nothing.
constexpr double kSureOfCrest = 3.0;
/// The squared slope may be so much more than it seems. Of 150 ellipses with 15 to 110 ribs of 0.1
/// to 1.2 mm and up to 0.4 mm of noise in all directions 57 are told with a word of what turns to
/// and fro: 54 of the tapes hold, and 48 of the contact lengths; with 1.3, 54 and 28.
constexpr double kMoreSlope = 1.6;
/// Steep waves have more of their points on flanks than on crests, and seem lower: by up to 0.82
/// (the root mean square of a cosine, weighed by its flanks, is that of a third, not of a half).
constexpr double kByFlanks = 0.22;
/// Of noise along the line against the waves, in radians: half of its square counts up to this.
constexpr double kMostBlur = 1.0;
/// The longest waves that a ribbon does not follow, and patches, which follow more: as much longer
/// ones as a patch is wide their own errors are shared too.
constexpr double kLongestOverRibbon = 0.06;
constexpr double kLongestOverPatches = 0.03;
/// A ribbon is so wide that skin changes across it.
constexpr std::size_t kAcrossRibbon = 5;
/// Of a band's columns, against the section: ribs that cross the plane aslant hardly move along it
/// within one.
constexpr double kColumn = 0.005;
constexpr double kMostColumns = 64.0;
/// Against the section: where points scatter less, nothing hides in it.
constexpr double kLeastScatter = 1e-4;
constexpr std::size_t kMostHeights = 3000;
/// Waves lower than this part of a step of the coordinates may be made by it: rounding scatters by
/// 0.29 of one.
constexpr double kOfAStep = 0.5;

/// Of the points in a row: the sum of what they weigh, and of that times their heights.
struct Row {
  std::ptrdiff_t number = 0;
  double weight = 0.0;
  double height = 0.0;
};
using Column = std::vector<Row>;

/// What rows share with those so many further on.
struct Shared {
  double heights = 0.0;  ///< products of two
  double weights = 0.0;
  /// Variance of `heights`, if they are noise: by those of whole rows, of which the points may have
  /// theirs in common.
  double chance = 0.0;
};

/// By the rows that they are apart, from kNearest to that many more. `columns`: rows that have
/// points, in their order.
std::vector<Shared> shared_by(const std::vector<Column>& columns, std::size_t most) {
  std::vector<Shared> all(most + 1);
  const auto furthest = kNearest + static_cast<std::ptrdiff_t>(most);
  for (const auto& rows : columns) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto ahead = [&](std::size_t j) {
        return rows[j % rows.size()].number - rows[i].number + (j < rows.size() ? 0 : kRows);
      };
      for (std::size_t j = i + 1; j < i + rows.size() && ahead(j) <= furthest; ++j) {
        if (ahead(j) < kNearest) continue;
        const Row& other = rows[j % rows.size()];
        const double heights = rows[i].height * other.height;
        Shared& shared = all[static_cast<std::size_t>(ahead(j) - kNearest)];
        shared.heights += heights;
        shared.chance += heights * heights;
        shared.weights += rows[i].weight * other.weight;
      }
    }
  }
  return all;
}

/// Of a wave to what is shared.
struct Fit {
  double heights = 0.0;
  double weights = 0.0;
  double chance = 0.0;

  void add(double alike, const Shared& here) {
    heights += alike * here.heights;
    weights += alike * alike * here.weights;
    chance += alike * alike * here.chance;
  }

  /// In standard deviations of noise.
  double sureness() const { return chance > 0.0 ? heights / std::sqrt(chance) : 0.0; }
};

/// Waves as they fit what is shared best.
struct Waves {
  double sureness = 0.0;
  double height = 0.0;
  double slope = 0.0;
};

/// Nothing where they are not plain. `wave`: in rows. Compared over one whole wave, so that what is
/// the same all along, as of much longer ones, counts for nothing.
Waves waves_of(const std::vector<Shared>& all, double wave, double row_length) {
  const double turn = 2.0 * std::numbers::pi / wave;
  Fit whole;
  Fit crest;
  for (std::size_t i = 0; i < std::min(all.size(), static_cast<std::size_t>(std::lround(wave)));
       ++i) {
    const double alike = std::cos(turn * (static_cast<double>(kNearest) + static_cast<double>(i)));
    whole.add(alike, all[i]);
    if (alike > 0.0) crest.add(alike, all[i]);
  }
  if (!(whole.sureness() > kSure && crest.sureness() > kSureOfCrest)) return {};
  const double height = std::sqrt(whole.heights / whole.weights);
  return {whole.sureness(), height, height * turn / row_length};
}

/// FinerSkin::blur: by what heights scatter beyond what is shared, `scatter` being all of it.
double blur_of(const Waves& waves, double scatter) {
  const double turns_a_length = waves.slope / waves.height;
  const double rest = std::max(scatter * scatter - waves.height * waves.height, 0.0);
  return std::exp(std::min(0.5 * turns_a_length * turns_a_length * rest, kMostBlur));
}

/// `longest`: in rows.
Waves plainest_waves(const std::vector<Column>& columns, double longest, double row_length) {
  const auto all = shared_by(columns, static_cast<std::size_t>(longest));
  Waves plainest;
  for (double wave = longest; wave >= kShortestWave; wave *= kShorter) {
    const Waves waves = waves_of(all, wave, row_length);
    if (waves.sureness > plainest.sureness) plainest = waves;
  }
  return plainest;
}

std::size_t part_of(double share, std::size_t parts) {
  const double part = std::clamp(share, 0.0, 1.0) * static_cast<double>(parts);
  return std::min(static_cast<std::size_t>(part), parts - 1);
}

/// Against what is known of its noise.
double size_of(const RibbonPoint& point) {
  return std::abs(point.height) * std::sqrt(point.certainty);
}

/// Those that are no strays.
std::vector<RibbonPoint> usual_of(std::vector<RibbonPoint> heights) {
  std::vector<double> sizes;
  sizes.reserve(heights.size());
  for (const auto& point : heights) sizes.push_back(size_of(point));
  const double most = kThreeSigmasInMedians * median(std::move(sizes));
  std::erase_if(heights, [&](const RibbonPoint& point) { return size_of(point) > most; });
  return heights;
}

/// Root mean square of the heights.
double scatter_of(const std::vector<RibbonPoint>& heights) {
  double squares = 0.0;
  double weights = 0.0;
  for (const auto& point : heights) {
    squares += point.certainty * point.height * point.height;
    weights += point.certainty;
  }
  return weights > 0.0 ? std::sqrt(squares / weights) : 0.0;
}

std::vector<Column> columns_of(const std::vector<RibbonPoint>& heights, double length,
                               std::size_t across) {
  std::vector<Column> columns(across, Column(kRows));
  for (const auto& point : heights) {
    const double round = point.way / length;
    const std::size_t row = part_of(round - std::floor(round), kRows);
    Row& here = columns[part_of(0.5 * (1.0 + point.off), across)][row];
    here.number = static_cast<std::ptrdiff_t>(row);
    here.weight += point.certainty;
    here.height += point.certainty * point.height;
  }
  for (auto& column : columns)
    std::erase_if(column, [](const Row& row) { return !(row.weight > 0.0); });
  return columns;
}

/// How far off the plane the furthest one of so many lies that are nearest to it.
double reach_of_nearest(const std::vector<OrientedPoint>& points, std::size_t most) {
  std::vector<double> off;
  off.reserve(points.size());
  for (const auto& point : points) off.push_back(std::abs(point.position.z()));
  if (off.size() <= most) return std::numeric_limits<double>::infinity();
  const auto last = off.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(off.begin(), last, off.end());
  return *last;
}

/// What either shows: high waves may be long, and steep ones low.
std::optional<FinerSkin> both(const std::optional<FinerSkin>& one,
                              const std::optional<FinerSkin>& other) {
  if (!one || !other) return one ? one : other;
  return FinerSkin{std::max(one->height, other->height), std::max(one->slope, other->slope),
                   std::max(one->blur, other->blur)};
}

}  // namespace

MissedLength missed_length(const FinerSkin& skin, double length) {
  const double steep = 2.0 * skin.blur * skin.blur * skin.slope * skin.slope;
  const double more = skin.blur * (1.0 + kByFlanks * steep / (1.0 + steep));
  const double tops = 2.0 * std::numbers::pi * std::numbers::sqrt2 * more * skin.height;
  const double slope = more * skin.slope;
  // The mean of roots is at most the root of the mean.
  const double folds = length * (std::sqrt(1.0 + kMoreSlope * slope * slope) - 1.0);
  return {std::max(tops, folds), tops};
}

std::optional<FinerSkin> finer_skin_of(const std::vector<RibbonPoint>& heights, double length,
                                       double longest, std::size_t across) {
  const auto usual = usual_of(heights);
  const auto columns = columns_of(usual, length, across);
  const double row_length = length / static_cast<double>(kRows);
  const Waves waves =
      plainest_waves(columns, std::min(longest / row_length, kLongestWave), row_length);
  if (!(waves.sureness > 0.0)) return std::nullopt;
  return FinerSkin{waves.height, waves.slope, blur_of(waves, scatter_of(usual))};
}

std::optional<FinerSkin> finer_skin_over(const RibbonSpline& spline,
                                         const std::vector<RibbonPoint>& points, double length) {
  std::vector<RibbonPoint> heights = points;
  for (auto& point : heights) point.height -= spline.at(point.way, point.off).value;
  const double longest = kLongestOverRibbon * length;
  return both(finer_skin_of(heights, length, longest, 1),
              finer_skin_of(heights, length, longest, kAcrossRibbon));
}

std::optional<FinerSkin> finer_skin_at(const PlaneBand& band, const BlendedSurface& surface,
                                       const ContourIndex& section) {
  if (band.shown_sigma < kLeastScatter) return std::nullopt;
  std::vector<RibbonPoint> heights;
  const double most = reach_of_nearest(band.points, kMostHeights);
  const double beside = evidence_reach(band);
  const double usual = band.sigma * band.sigma;
  double reach = 0.0;
  for (std::size_t i = 0; i < band.points.size(); ++i) {
    // What was put where nobody looked, and what stays of piles, lies on the surface.
    if (!band.seen[i] || band.error_of(i) > 0.0) continue;
    const OrientedPoint& point = band.points[i];
    const double off = point.position.z();
    if (std::abs(off) > most || !may_run_to(section, point, beside)) continue;
    const auto field = surface.at(point.position);
    if (!field) continue;
    const double way = section.foot_of(point.position.head<2>()).way;
    heights.push_back({way, off, field->value, usual / point.variance});
    reach = std::max(reach, std::abs(off));
  }
  const double length = section.length();
  const double longest = kLongestOverPatches * length;
  const auto along = finer_skin_of(heights, length, longest, 1);
  if (!(reach > 0.0)) return along;
  for (auto& point : heights) point.off /= reach;
  const double columns = std::min(std::ceil(2.0 * reach / (kColumn * length)), kMostColumns);
  return both(along, finer_skin_of(heights, length, longest, static_cast<std::size_t>(columns)));
}

bool may_be_rounding(const FinerSkin& skin, double unit_mm, const PointCloud& cloud) {
  return is_coordinate_step_over(unit_mm * skin.height / kOfAStep, cloud.positions);
}

}  // namespace instep
