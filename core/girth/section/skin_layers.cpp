#include "core/girth/section/skin_layers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "core/mean.h"
#include "core/stride.h"

namespace instep {
namespace {

constexpr std::size_t kFewest = 40;
constexpr double kLeastHeap = 0.1;
/// Half-way between the means, and round both, those within this part of their distance are
/// counted.
constexpr double kHalfWindow = 1.0 / 6.0;
/// Fewer half-way than this part of those round either mean, and by so many deviations of their
/// number. Of 353 drawn cases of one skin (tests/bench/accuracy) the part is 0.85 at least and 2 as
/// a rule, of two layers 2 mm apart that scatter by 0.3 mm at most 0.25.
constexpr double kMostBetween = 0.5;
constexpr double kPlainly = 3.0;
/// Of a second layer from the surface, of two layers from each other, and what these scatter at
/// least, against the section: nearer ones do not matter.
constexpr double kFurthestLayer = 0.08;
constexpr double kNearestLayers = 0.002;
constexpr double kScatterOfLayers = 3e-4;
constexpr double kLayersMore = 1.1;
/// So many points at most are asked, an even part of more.
constexpr std::size_t kMostHeights = 800;
constexpr std::size_t kMostSectors = 8;
constexpr std::size_t kHeightsOfSector = 50;

/// Into the first `count` and the rest.
struct Parting {
  std::size_t count = 0;
  SkinLayers means;
};

/// `heights` sorted, two at least.
Parting furthest_parted(const std::vector<double>& heights) {
  const auto all = static_cast<double>(heights.size());
  const double total = std::accumulate(heights.begin(), heights.end(), 0.0);
  Parting best;
  double furthest = -1.0;
  double sum = 0.0;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    sum += heights[i - 1];
    const auto below = static_cast<double>(i);
    const SkinLayers means{sum / below, (total - sum) / (all - below)};
    const double parted = below * (all - below) * std::pow(means.outer - means.inner, 2);
    if (parted <= furthest) continue;
    furthest = parted;
    best = {i, means};
  }
  return best;
}

double count_within(const std::vector<double>& heights, double middle, double half_width) {
  const auto first = std::lower_bound(heights.begin(), heights.end(), middle - half_width);
  const auto last = std::upper_bound(heights.begin(), heights.end(), middle + half_width);
  return static_cast<double>(last - first);
}

/// Of a point over the surface.
struct PlacedHeight {
  Eigen::Vector2d place;  ///< on the tape plane
  double height = 0.0;
};

std::vector<PlacedHeight> heights_near_plane(const PlaneBand& band, const BlendedSurface& surface,
                                             double near) {
  std::vector<PlacedHeight> heights;
  const std::size_t stride = stride_to_at_most(kMostHeights, band.points.size());
  for (std::size_t i = 0; i < band.points.size(); i += stride) {
    const Eigen::Vector3d& position = band.points[i].position;
    if (std::abs(position.z()) > near) continue;
    const auto field = surface.at(position);
    if (!field || std::abs(field->value) >= kFurthestLayer) continue;
    heights.push_back({position.head<2>(), field->value});
  }
  return heights;
}

struct LayeredSectors {
  std::size_t count = 0;
  std::optional<SkinLayers> furthest;  ///< from the surface
};

/// The first of `count` sectors round `middle` begins so many of them past the x axis.
LayeredSectors layered_sectors(const std::vector<PlacedHeight>& heights,
                               const Eigen::Vector2d& middle, std::size_t count, double past) {
  std::vector<std::vector<double>> sectors(count);
  for (const auto& one : heights) {
    const Eigen::Vector2d from = one.place - middle;
    const double turns = std::atan2(from.y(), from.x()) / (2.0 * std::numbers::pi) + 1.0;
    const auto sector = static_cast<std::size_t>(turns * static_cast<double>(count) + past);
    sectors[sector % count].push_back(one.height);
  }
  LayeredSectors layered;
  for (auto& sector : sectors) {
    const auto layers = layers_among(std::move(sector));
    if (!layers) continue;
    ++layered.count;
    if (!layered.furthest || reach_of(*layers) > reach_of(*layered.furthest)) {
      layered.furthest = layers;
    }
  }
  return layered;
}

/// Seen from the middle of all, by the sectors of two partings that show more. The layers may reach
/// into the sectors beside those that show them, so that only where all of both do they are all
/// round.
std::optional<SkinLayers> layers_in_sectors(const std::vector<PlacedHeight>& heights) {
  const std::size_t count = std::min(kMostSectors, heights.size() / kHeightsOfSector);
  if (count < 2) return std::nullopt;
  const Eigen::Vector2d middle = mean_of(heights, &PlacedHeight::place);
  const auto one = layered_sectors(heights, middle, count, 0.0);
  const auto other = layered_sectors(heights, middle, count, 0.5);
  auto [layered, furthest] = one.count >= other.count ? one : other;
  if (!furthest) return std::nullopt;
  const double share = static_cast<double>(layered + 2) / static_cast<double>(count);
  furthest->turn *= std::min(1.0, share);
  furthest->are_all_round = one.count == count && other.count == count;
  return furthest;
}

}  // namespace

std::optional<SkinLayers> layers_among(std::vector<double> heights) {
  if (heights.size() < kFewest) return std::nullopt;
  std::sort(heights.begin(), heights.end());
  const auto [count, means] = furthest_parted(heights);
  const auto least = kLeastHeap * static_cast<double>(heights.size());
  const auto lower = static_cast<double>(count);
  if (lower < least || static_cast<double>(heights.size()) - lower < least) return std::nullopt;
  const double half_width = kHalfWindow * (means.outer - means.inner);
  const double between = count_within(heights, 0.5 * (means.inner + means.outer), half_width);
  const double round_least = std::min(count_within(heights, means.inner, half_width),
                                      count_within(heights, means.outer, half_width));
  if (between > kMostBetween * round_least) return std::nullopt;
  if (!(round_least - between > kPlainly * std::sqrt(round_least))) return std::nullopt;
  return means;
}

std::optional<SkinLayers> layers_near_plane(const PlaneBand& band, const BlendedSurface& surface,
                                            double near) {
  if (band.shown_sigma < kScatterOfLayers) return std::nullopt;
  const auto places = heights_near_plane(band, surface, near);
  std::vector<double> heights;
  for (const auto& place : places) heights.push_back(place.height);
  auto layers = layers_among(std::move(heights));
  const auto in_sectors = layers_in_sectors(places);
  if (layers && in_sectors) layers->are_all_round = in_sectors->are_all_round;
  if (!layers) layers = in_sectors;
  if (!layers || layers->outer - layers->inner < kNearestLayers) return std::nullopt;
  return layers;
}

double reach_of(const SkinLayers& layers) {
  return kLayersMore * layers.turn * std::max(layers.outer, -layers.inner);
}

}  // namespace instep
