#include "core/girth/band/plane_band.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/geometry/cell_crowds.h"
#include "core/geometry/near_copies.h"
#include "core/geometry/point_spacing.h"
#include "core/geometry/strays/strays.h"
#include "core/girth/band/section_probe.h"
#include "core/girth/band/sure_noise.h"
#include "core/girth/refusals.h"
#include "core/median.h"
#include "core/surface/normals/cell_normals.h"
#include "core/surface/normals/normal_trust.h"

namespace instep {
namespace {

/// Half-width of the band in grains: a patch of points as wide apart as the grain reaches more than
/// four to each side, and the normals of its outermost points two more.
constexpr double kBandInGrains = 6.5;
constexpr double kWideEnough = 1.15;
constexpr int kMostRounds = 3;
/// Points nearer to each other than this part of the spacing are copies of one, if so many have
/// such a neighbour: two thirds of a cloud of which half was added again. Of a random cloud 7 % do,
/// of points along rows half.
constexpr double kCopy = 0.15;
constexpr double kManyCopies = 0.6;
/// Places where noise is looked for lie so near to the plane.
constexpr double kNoisePlacesInSpacings = 1.5;
/// A grain is this many standard deviations of the noise, up to this part of the section.
constexpr double kGrainInSigmas = 2.0;
constexpr double kCoarsestGrain = 0.018;
/// Noise of more spacings is told anew in the wider band that it asks for: in one that was made for
/// exact points no neighbourhood is as wide as the noise is thick.
constexpr double kThickInSpacings = 1.5;
/// Exact points are thinned where they stand nearer than this part of the finest grain: of others
/// few share a cell as wide as that.
constexpr double kCrowded = 0.85;
/// Side of the cells that share a normal, as large in a thinned crowd as in a cloud of half
/// its points, and the fewest points for one.
constexpr double kNormalCellInGrains = 1.5;
constexpr double kNormalCellInThinned = 2.2;
constexpr double kNormalCellInSigmas = 3.3;
/// Of a cell, against the section: three of them in a row must not reach round the body.
constexpr double kLargestNormalCell = 0.05;
constexpr std::size_t kFewestNormalPoints = 16;
/// Noise in places, against what was told, that whoever reads the girth should know of: what shows
/// less is measured with what it shows.
constexpr double kNotableInPlaces = 1.5;
/// What is told to be less is none, but has a square.
constexpr double kLeastToldMm = 1e-9;
/// Of what was told, from which on nobody asks how many.
constexpr double kManyTimes = 100.0;
/// Noise of more than this part of the spacing rounds an edge in any case: patches of the points
/// that face one way by what was told would end there as if it did not. Of lasts of 14,240 points
/// with 0.5 mm girths were 0.36 mm off so, and are 0.34; of drawn bodies 0.297 and 0.293.
constexpr double kHidesTurns = 0.2;
/// Of a section: the texture of skin or a scanner's rounding.
constexpr double kHarmlessScatter = 3e-4;

double grain_of(double spacing, double sigma) {
  return std::max({spacing, std::min(kGrainInSigmas * sigma, kCoarsestGrain), kFinestGrain});
}

PlaneBand band_of(PlaneSlab slab, const SectionProbe& found) {
  PlaneBand band{.unit_mm = found.unit_mm,
                 .middle_mm = found.middle_mm.head<2>(),
                 .points = {},
                 .index = PointIndex(std::move(slab.places)),
                 .sources = std::move(slab.indices),
                 .shares = std::move(slab.shares),
                 .errors_mm = std::move(slab.errors_mm),
                 .seen = {},
                 .uneven = {},
                 .scattered = {},
                 .roughness = {}};
  band.spacing = usual_spacing(band.index, kSpacingSample);
  band.stray_share = found.stray_share;
  return band;
}

/// The points within `half_width` of the plane.
PlaneBand gather(SlabSource& slabs, const SectionProbe& found, double half_width) {
  return band_of(found.slab(slabs, half_width), found);
}

/// Leaves out the points that are marked.
void drop(const std::vector<bool>& marked, PlaneBand& band) {
  PlaneSlab rest = without(marked, {std::move(band.sources), band.index.points(),
                                    std::move(band.shares), std::move(band.errors_mm)});
  band.sources = std::move(rest.indices);
  band.shares = std::move(rest.shares);
  band.errors_mm = std::move(rest.errors_mm);
  band.index = PointIndex(std::move(rest.places));
}

void drop_copies(PlaneBand& band) {
  const double apart = kCopy * band.spacing;
  if (!(apart > 0.0)) return;
  if (share_of_near_copies(band.index, apart, kSpacingSample) <= kManyCopies) return;
  band.copies_within = apart;
  drop(near_copies(band.index.points(), apart), band);
  band.spacing = usual_spacing(band.index, kSpacingSample);
}

/// As wide a band as its grain asks for.
PlaneBand gather_enough(SlabSource& slabs, const SectionProbe& found, double sigma) {
  double half_width = kBandInGrains * grain_of(found.spacing, sigma);
  for (int round = 0;; ++round) {
    slabs.level_piles(kFinestGrain * found.unit_mm, half_width * found.unit_mm);
    PlaneBand band = gather(slabs, found, half_width);
    drop_copies(band);
    band.grain = grain_of(band.spacing, sigma);
    if (round == kMostRounds || kBandInGrains * band.grain < kWideEnough * half_width) return band;
    half_width = kBandInGrains * band.grain;
  }
}

void drop_strays(bool near_skin, PlaneBand& band) {
  if (!(band.spacing > 0.0)) return;
  const auto strays = strays_among(band.index, band.spacing, {band.stray_share, near_skin});
  if (std::find(strays.begin(), strays.end(), true) == strays.end()) return;
  const double all = static_cast<double>(band.sources.size()) / (1.0 - band.stray_share);
  drop(strays, band);
  band.stray_share = 1.0 - static_cast<double>(band.sources.size()) / all;
}

/// Points next to the plane that were seen, in the order in which they lie round the middle. Those
/// that were put where nobody looked have no noise, and those that stay of piles little.
std::vector<std::size_t> along_the_plane(const PointCloud& cloud, const PlaneBand& band) {
  const auto& places = band.index.points();
  std::vector<std::pair<double, std::size_t>> angles;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (std::abs(places[i].z()) > kNoisePlacesInSpacings * band.spacing) continue;
    if (!cloud.was_seen(band.sources[i]) || band.error_of(i) > 0.0) continue;
    angles.emplace_back(std::atan2(places[i].y(), places[i].x()), i);
  }
  std::sort(angles.begin(), angles.end());
  std::vector<std::size_t> indices;
  for (const auto& [angle, index] : angles) indices.push_back(index);
  return indices;
}

/// What is told of the noise of each point, in the band's unit; nothing if nothing is.
std::vector<double> told_sigmas(const SlabSource& slabs, const PlaneBand& band) {
  const PointCloud& cloud = slabs.cloud();
  const auto sigma_mm = slabs.sigma_mm();
  if (!sigma_mm && !cloud.has_sigma()) return {};
  std::vector<double> told;
  for (std::size_t i = 0; i < band.sources.size(); ++i) {
    const double of_point = sigma_mm ? *sigma_mm : cloud.sigma_mm[band.sources[i]];
    told.push_back(band.share_of(i) * std::max(of_point, kLeastToldMm) / band.unit_mm);
  }
  return told;
}

/// In the band's unit.
NoiseEstimate noise_of(const SlabSource& slabs, const PlaneBand& band) {
  return estimate_noise(band.index, along_the_plane(slabs.cloud(), band), told_sigmas(slabs, band));
}

/// A band, and in its unit what its points show of noise.
struct BandAndNoise {
  PlaneBand band;
  NoiseEstimate noise;
};

/// Of points that crowd, of which nothing is told and which are exact wherever they are looked at,
/// as many as tell the same: those left out would tell it again. Nothing of others.
std::optional<BandAndNoise> thinned(SlabSource& slabs, const SectionProbe& found) {
  const PointCloud& cloud = slabs.cloud();
  const bool told =
      slabs.sigma_mm() || cloud.has_normals() || cloud.has_sigma() || !cloud.origins.empty();
  if (told || found.spacing > kCrowded * kFinestGrain) return std::nullopt;
  const PlaneSlab slab = found.slab(slabs, kBandInGrains * kFinestGrain);
  const CellCrowds crowds = crowds_in_cells(slab.places, kFinestGrain);
  if (crowds.has_pile()) return std::nullopt;
  PlaneBand band = band_of(without(crowds.crowding, slab), found);
  band.thinned_out = slab.places.size() - band.sources.size();
  band.grain = grain_of(band.spacing, 0.0);
  auto noise = estimate_if_exact(band.index, along_the_plane(cloud, band));
  if (!noise) return std::nullopt;
  drop_strays(false, band);
  // What strays are beside them the whole crowd tells.
  if (band.stray_share > 0.0) return std::nullopt;
  return BandAndNoise{std::move(band), std::move(*noise)};
}

/// All points of as wide a band as they ask for. Nothing if they form no surface.
std::optional<BandAndNoise> whole(SlabSource& slabs, const SectionProbe& found,
                                  bool strays_near_skin) {
  PlaneBand band = gather_enough(slabs, found, 0.0);
  drop_strays(strays_near_skin, band);
  if (band.sources.size() < kFewestPoints || !(band.spacing > 0.0)) return std::nullopt;
  NoiseEstimate noise = noise_of(slabs, band);
  if (grain_of(band.spacing, noise.sigma) > band.grain) {
    band = gather_enough(slabs, found, noise.sigma);
    drop_strays(strays_near_skin, band);
    if (band.sources.size() < kFewestPoints) return std::nullopt;
    if (noise.sigma > kThickInSpacings * band.spacing) {
      noise = noise_of(slabs, band);
    }
  }
  return BandAndNoise{std::move(band), std::move(noise)};
}

/// A direction of the cloud as the plane sees it.
Eigen::Vector3d turned(const Eigen::Vector3d& direction, const TapePlane& plane) {
  return {plane.u().dot(direction), plane.v().dot(direction), plane.normal().dot(direction)};
}

/// Those that came with the points; none if none did.
std::vector<Eigen::Vector3d> told_normals(const PointCloud& cloud, const TapePlane& plane,
                                          const PlaneBand& band) {
  std::vector<Eigen::Vector3d> normals;
  if (!cloud.has_normals()) return normals;
  // Rounded as places are, so that what is equal stays so wherever the cloud lies.
  constexpr double kSteps = 0x1p36;
  for (const std::size_t source : band.sources) {
    const Eigen::Vector3d normal = turned(cloud.normals[source], plane);
    normals.emplace_back((kSteps * normal).array().round() / kSteps);
  }
  return normals;
}

/// Those that the points show.
std::vector<Eigen::Vector3d> shown_normals(const PointCloud& cloud, const TapePlane& plane,
                                           const PlaneBand& band) {
  const double grains = band.thinned_out > 0 ? kNormalCellInThinned : kNormalCellInGrains;
  const double sigma = std::max(band.sigma, most_scatter(band.scattered));
  const double side =
      std::min(std::max(grains * band.grain, kNormalCellInSigmas * sigma), kLargestNormalCell);
  CellNormals cells(band.index, side, sigma, kFewestNormalPoints);
  if (cloud.view_directions.empty()) cells.orient_by_neighbours();
  std::vector<Eigen::Vector3d> normals = cells.of_points();
  if (cloud.view_directions.empty()) return normals;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const auto view = turned(cloud.view_directions[band.sources[i]], plane);
    if (normals[i].dot(view) < 0.0) normals[i] *= -1.0;
  }
  return normals;
}

/// Those that the points show, on the sides that were told.
std::vector<Eigen::Vector3d> shown_on_sides_of(const std::vector<Eigen::Vector3d>& told,
                                               const PointCloud& cloud, const TapePlane& plane,
                                               const PlaneBand& band) {
  auto normals = shown_normals(cloud, plane, band);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (normals[i].dot(told[i]) < 0.0) normals[i] *= -1.0;
  }
  return normals;
}

void set_points(const PointCloud& cloud, const TapePlane& plane, PlaneBand& band) {
  auto normals = told_normals(cloud, plane, band);
  const bool righted = right_lone_normals(normals, band.index);
  const auto trust = normals.empty() ? NormalTrust::kNone : trust_in(normals, band.index);
  band.normals_dropped = !normals.empty() && trust == NormalTrust::kNone;
  if (trust == NormalTrust::kNone) {
    normals = shown_normals(cloud, plane, band);
  } else if (band.sigma > kHidesTurns * band.spacing) {
    normals = shown_on_sides_of(normals, cloud, plane, band);
  }
  const double least = 1e-9 * band.spacing;
  const bool slopes = trust == NormalTrust::kSlopes && !righted && band.spacing >= kFinestGrain;
  band.points.reserve(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double sigma = std::max(band.sigma_of(cloud, band.sources[i], band.share_of(i),
                                                band.error_of(i), band.index.points()[i]),
                                  least);
    const bool told = slopes && is_harmless(sigma * sigma, band.spacing, false);
    band.points.push_back({band.index.points()[i], normals[i], sigma * sigma, told, false});
  }
}

/// Against the usual noise, what it is where it is most.
double most_uneven(const PlaneBand& band) {
  double times = 1.0;
  for (const auto& local : band.uneven) times = std::max(times, local.times);
  return times;
}

std::string disbelief_of_noise(const PlaneBand& band) {
  const double times = most_uneven(band);
  const double sigma_mm = times * band.unit_mm * band.sigma / band.usual_share;
  char figures[64];
  const double times_told = times * band.told_scale;
  if (times_told < kManyTimes) {
    std::snprintf(figures, sizeof figures, "%.2f mm, %.1f times", sigma_mm, times_told);
  } else {
    std::snprintf(figures, sizeof figures, "%.2f mm, more than a hundred times", sigma_mm);
  }
  const bool in_places = !band.uneven.empty();
  const std::string remedy = band.own_sigma ? "see to the sensor and scan again with more frames"
                             : in_places    ? "leave --sigma-mm out"
                                            : "leave --sigma-mm out or give this one";
  return std::string(in_places ? "in places " : "") + "the points scatter by " + figures +
         " the noise that was told of them, which was not believed: " + remedy;
}

}  // namespace

double PlaneBand::noise_mm() const {
  return unit_mm * std::max(sigma / usual_share, mean_scatter(scattered));
}

/// What stands for skin that nobody saw is told of by who put it there: what points show is no word
/// on it.
double PlaneBand::sigma_of(const PointCloud& cloud, std::size_t source, double share,
                           double error_mm, const Eigen::Vector3d& place) const {
  const double times = uneven.empty() ? 1.0 : times_at(uneven, place);
  const double error = error_mm / unit_mm;
  if (!own_sigma && error > 0.0) return error;
  if (!own_sigma) {
    return std::max(times * sigma * share / usual_share, scatter_at(scattered, place));
  }
  const double told = (cloud.was_seen(source) ? told_scale * times : 1.0) *
                      std::max(cloud.sigma_mm[source], kLeastToldMm);
  return std::max(share * told / unit_mm, error);
}

Result<PlaneBand> band_at(SlabSource& slabs, bool strays_near_skin) {
  const PointCloud& cloud = slabs.cloud();
  if (cloud.size() < kFewestPoints) {
    return fail(ErrorCode::kInsufficientData, "the cloud has too few points for a surface",
                "scan again");
  }
  const auto found = probe_section(slabs);
  if (!found) return tl::make_unexpected(found.error());
  auto made = strays_near_skin ? std::nullopt : thinned(slabs, *found);
  if (!made) made = whole(slabs, *found, strays_near_skin);
  if (!made) return no_surface();
  auto& [band, noise] = *made;
  if (!is_cut(band.index.points())) return only_touched();
  if (!band.shares.empty()) band.usual_share = median(band.shares);
  band.stray_share += slabs.stray_share();
  band.sigma = noise.sigma;
  band.shown_sigma = noise.shown;
  band.told_scale = noise.told_scale;
  band.uneven = std::move(noise.uneven);
  band.scattered = std::move(noise.scattered);
  band.own_sigma = !slabs.sigma_mm() && cloud.has_sigma();
  band.roughness = std::move(noise.roughness);
  for (const std::size_t source : band.sources) band.seen.push_back(cloud.was_seen(source));
  set_points(cloud, slabs.plane(), band);
  const bool is_sure = is_surely_noise(band, cloud, band.own_sigma || slabs.sigma_mm());
  for (auto& point : band.points) point.surely_noise = is_sure;
  return std::move(band);
}

std::vector<std::string> disbelief_of(const PlaneBand& band) {
  std::vector<std::string> said;
  const bool notable =
      band.uneven.empty() || most_uneven(band) * band.told_scale > kNotableInPlaces;
  if (band.told_scale > 1.0 && band.sigma > kHarmlessScatter * band.usual_share && notable) {
    said.push_back(disbelief_of_noise(band));
  }
  if (band.normals_dropped) {
    said.emplace_back(
        "the normals that came with the points contradict each other or point inwards, and were "
        "not used: have them made anew, or leave them out of the file");
  }
  return said;
}

}  // namespace instep
