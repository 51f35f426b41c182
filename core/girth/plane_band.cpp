#include "core/girth/plane_band.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/stray_points.h"
#include "core/girth/plane_slab.h"
#include "core/median.h"
#include "core/surface/surface_normals.h"

namespace instep {
namespace {

constexpr std::size_t kFewestPoints = 24;
/// Half-width of the band in grains: a patch reaches five to each side, and normals two more.
constexpr double kBandInGrains = 7.5;
constexpr double kFirstHalfWidth = 0.03;
/// Points of a slab thinner than their spacing seem farther apart than they are.
constexpr double kWidening = 1.6;
constexpr double kMostWidening = 2.6;
constexpr std::size_t kSpacingSample = 200;
/// A grain is this many standard deviations of the noise, up to this part of the section.
constexpr double kGrainInSigmas = 2.0;
constexpr double kCoarsestGrain = 0.018;
/// Points nearer than this part of the section tell no more than fewer would.
constexpr double kFinestGrain = 0.01;
/// Side of the cells that share a normal, and the fewest points for one.
constexpr double kNormalCellInGrains = 1.5;
constexpr double kNormalCellInSigmas = 3.3;
constexpr std::size_t kFewestNormalPoints = 16;

/// How far the points lie from their middle: a length that turns and scales with them.
double extent(const PointCloud& cloud, const TapePlane& plane) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0.0;
  for (const auto& position : cloud.positions) {
    const Eigen::Vector3d arm = position - plane.origin();
    sum += arm;
    squares += arm.squaredNorm();
  }
  const auto count = static_cast<double>(cloud.size());
  return std::sqrt(std::max(squares / count - (sum / count).squaredNorm(), 0.0));
}

double section_size(const std::vector<Eigen::Vector3d>& places) {
  Eigen::AlignedBox2d box;
  for (const auto& place : places) box.extend(place.head<2>().eval());
  return box.diagonal().norm();
}

double grain_of(double spacing, double sigma, double size) {
  const double noisy = std::min(kGrainInSigmas * sigma, kCoarsestGrain * size);
  return std::max({spacing, noisy, kFinestGrain * size});
}

/// Points beside the plane with their index.
struct Gathered {
  std::vector<std::size_t> sources;
  PointIndex index;
  double half_width = 0.0;
  double spacing = 0.0;
};

Gathered gather(const PointCloud& cloud, const TapePlane& plane, double half_width) {
  PlaneSlab slab = slab_of(cloud, plane, half_width);
  Gathered gathered{std::move(slab.indices), PointIndex(std::move(slab.places)), half_width, 0.0};
  gathered.spacing = usual_spacing(gathered.index, kSpacingSample);
  return gathered;
}

/// Widens the slab until it holds the neighbourhoods of all points on the plane.
Result<Gathered> gather_enough(const PointCloud& cloud, const TapePlane& plane) {
  const double size = extent(cloud, plane);
  double half_width = kFirstHalfWidth * size;
  while (half_width < 3.0 * size) {
    Gathered gathered = gather(cloud, plane, half_width);
    if (gathered.sources.size() < kFewestPoints) {
      half_width *= kWidening;
      continue;
    }
    const double grain = grain_of(gathered.spacing, 0.0, section_size(gathered.index.points()));
    if (half_width >= kBandInGrains * grain) return gathered;
    half_width *= std::clamp(1.05 * kBandInGrains * grain / half_width, kWidening, kMostWidening);
  }
  return fail(ErrorCode::kInvalidInput, "too few points lie near the tape plane",
              "give control points on the body, or a denser cloud");
}

void drop_strays(Gathered& gathered) {
  if (!(gathered.spacing > 0.0)) return;
  const auto strays = stray_points(gathered.index, gathered.spacing);
  if (std::find(strays.begin(), strays.end(), true) == strays.end()) return;
  std::vector<std::size_t> sources;
  std::vector<Eigen::Vector3d> places;
  for (std::size_t i = 0; i < strays.size(); ++i) {
    if (strays[i]) continue;
    sources.push_back(gathered.sources[i]);
    places.push_back(gathered.index.points()[i]);
  }
  gathered.sources = std::move(sources);
  gathered.index = PointIndex(std::move(places));
}

/// Points next to the plane, in the order in which they lie round the middle.
std::vector<std::size_t> along_the_plane(const Gathered& gathered) {
  const auto& places = gathered.index.points();
  Eigen::AlignedBox3d box;
  for (const auto& place : places) box.extend(place);
  std::vector<std::pair<double, std::size_t>> angles;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (std::abs(places[i].z()) > 1.5 * gathered.spacing) continue;
    const Eigen::Vector3d arm = places[i] - box.center();
    angles.emplace_back(std::atan2(arm.y(), arm.x()), i);
  }
  std::sort(angles.begin(), angles.end());
  std::vector<std::size_t> indices;
  for (const auto& [angle, index] : angles) indices.push_back(index);
  return indices;
}

bool lies_on_both_sides(const std::vector<Eigen::Vector3d>& places) {
  const auto above = std::count_if(places.begin(), places.end(),
                                   [](const auto& place) { return place.z() > 0.0; });
  const auto count = static_cast<std::ptrdiff_t>(places.size());
  return above * 20 > count && (count - above) * 20 > count;
}

/// A direction of the cloud as the plane sees it.
Eigen::Vector3d turned(const Eigen::Vector3d& direction, const TapePlane& plane) {
  return {plane.u().dot(direction), plane.v().dot(direction), plane.normal().dot(direction)};
}

/// Moves the band into its own unit, in which the section is about one long.
PlaneBand in_own_unit(const PointCloud& cloud, const Gathered& gathered,
                      const NoiseEstimate& noise) {
  Eigen::AlignedBox2d box;
  for (const auto& place : gathered.index.points()) box.extend(place.head<2>().eval());
  const double unit = box.diagonal().norm();
  const Eigen::Vector3d middle(box.center().x(), box.center().y(), 0.0);
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(gathered.sources.size());
  for (const auto& place : gathered.index.points()) positions.push_back((place - middle) / unit);
  PlaneBand band{unit, box.center(), {}, PointIndex(std::move(positions)), {}, {}, 0, 0, 0, {}};
  band.sources = gathered.sources;
  for (const std::size_t source : band.sources) band.seen.push_back(cloud.was_seen(source));
  band.spacing = gathered.spacing / unit;
  band.sigma = noise.sigma / unit;
  band.grain = grain_of(band.spacing, band.sigma, 1.0);
  for (const auto& local : noise.roughness) {
    band.roughness.push_back({(local.place - middle) / unit, local.roughness * unit});
  }
  return band;
}

std::vector<Eigen::Vector3d> outward_normals(const PointCloud& cloud, const TapePlane& plane,
                                             const PlaneBand& band) {
  std::vector<Eigen::Vector3d> normals;
  if (cloud.has_normals()) {
    for (const std::size_t source : band.sources) {
      normals.push_back(turned(cloud.normals[source], plane));
    }
    return normals;
  }
  const double side =
      std::max(kNormalCellInGrains * band.grain, kNormalCellInSigmas * band.sigma);
  CellNormals cells(band.index.points(), band.index, side, kFewestNormalPoints);
  if (cloud.view_directions.empty()) cells.orient_by_neighbours();
  normals = cells.of_points();
  if (cloud.view_directions.empty()) return normals;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const auto view = turned(cloud.view_directions[band.sources[i]], plane);
    if (normals[i].dot(view) < 0.0) normals[i] *= -1.0;
  }
  return normals;
}

void set_points(const PointCloud& cloud, const TapePlane& plane, bool own_sigma, PlaneBand& band) {
  const auto normals = outward_normals(cloud, plane, band);
  const double least = 1e-9 * band.spacing;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double sigma =
        own_sigma ? cloud.sigma_mm[band.sources[i]] / band.unit_mm : std::max(band.sigma, least);
    band.points.push_back({band.index.points()[i], normals[i], sigma * sigma});
  }
}

tl::unexpected<Error> no_surface() {
  return fail(ErrorCode::kInsufficientData, "the points near the tape plane form no surface",
              "scan again");
}

}  // namespace

Result<PlaneBand> band_at(const PointCloud& cloud, const TapePlane& plane,
                          std::optional<double> sigma_mm) {
  if (cloud.size() < kFewestPoints) {
    return fail(ErrorCode::kInsufficientData, "the cloud has too few points for a surface",
                "scan again");
  }
  auto gathered = gather_enough(cloud, plane);
  if (!gathered) return tl::make_unexpected(gathered.error());
  drop_strays(*gathered);
  if (gathered->sources.size() < kFewestPoints || !(gathered->spacing > 0.0)) return no_surface();

  const bool own_sigma = !sigma_mm && cloud.has_sigma();
  if (own_sigma) {
    std::vector<double> sigmas;
    for (const std::size_t source : gathered->sources) sigmas.push_back(cloud.sigma_mm[source]);
    sigma_mm = median(sigmas);
  }
  const NoiseEstimate noise = estimate_noise(gathered->index.points(), gathered->index,
                                             along_the_plane(*gathered), sigma_mm);
  const double size = section_size(gathered->index.points());
  const double half_width = kBandInGrains * grain_of(gathered->spacing, noise.sigma, size);
  if (half_width > gathered->half_width) {
    *gathered = gather(cloud, plane, half_width);
    drop_strays(*gathered);
  }
  if (!lies_on_both_sides(gathered->index.points())) {
    return fail(ErrorCode::kInvalidInput, "the tape plane only touches the body",
                "give control points that cut the body");
  }
  if (!(section_size(gathered->index.points()) > 0.0)) return no_surface();
  PlaneBand band = in_own_unit(cloud, *gathered, noise);
  set_points(cloud, plane, own_sigma, band);
  return band;
}

}  // namespace instep
