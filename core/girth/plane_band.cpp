#include "core/girth/plane_band.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/geometry/point_index.h"
#include "core/girth/plane_slab.h"
#include "core/median.h"
#include "core/surface/noise_estimate.h"
#include "core/surface/surface_normals.h"

namespace instep {
namespace {

constexpr std::size_t kFewestPoints = 24;
/// Half-width of the band in spacings: a patch reaches five to each side.
constexpr double kBandInSpacings = 9.0;
/// Neighbours that tell the spacing, and how much sparser than its surroundings a stray point is.
constexpr std::size_t kSpacingNeighbours = 8;
constexpr double kStrayRatio = 2.5;
/// Points nearer than this part of the spacing count as one.
constexpr double kDuplicate = 0.02;
/// Noisy points are averaged over this many standard deviations, up to this part of the section.
constexpr double kAveragedSigmas = 2.0;
constexpr double kWidestAverage = 0.018;
/// Points nearer than this part of the section tell no more about it than their average.
constexpr double kFinest = 0.007;

constexpr double kNormalReachInSigmas = 5.0;
constexpr std::size_t kFewestNormalPoints = 16;
constexpr std::size_t kMostNormalPoints = 100;

/// Side of the square that a point has for itself, by the distance to its k-th neighbour.
double own_spacing(const std::vector<PointIndex::Neighbour>& nearest) {
  const auto found = static_cast<double>(nearest.size() - 1);
  return std::sqrt(nearest.back().squared_distance * std::numbers::pi / std::max(found, 1.0));
}

double spacing_of(const std::vector<Eigen::Vector3d>& places, const PointIndex& index) {
  std::vector<double> spacings;
  const std::size_t stride = std::max<std::size_t>(1, places.size() / 400);
  for (std::size_t i = 0; i < places.size(); i += stride) {
    spacings.push_back(own_spacing(index.nearest(places[i], kSpacingNeighbours + 1)));
  }
  return median(spacings);
}

/// Size of the cloud as the plane sees it, so that it turns with the two.
double extent(const PointCloud& cloud, const TapePlane& plane) {
  Eigen::AlignedBox3d box;
  for (const auto& position : cloud.positions) {
    const Eigen::Vector2d place = plane.project(position);
    box.extend(Eigen::Vector3d(place.x(), place.y(), plane.distance(position)));
  }
  return box.diagonal().norm();
}

/// Widens the slab until it holds the neighbourhoods of all points on the plane.
Result<std::pair<PlaneSlab, double>> wide_enough_slab(const PointCloud& cloud,
                                                      const TapePlane& plane) {
  const double size = extent(cloud, plane);
  for (double half_width = 0.01 * size; half_width < 0.6 * size; half_width *= 1.4) {
    PlaneSlab slab = slab_of(cloud, plane, half_width);
    if (slab.indices.size() < kFewestPoints) continue;
    const double spacing = spacing_of(slab.places, PointIndex(slab.places));
    if (half_width >= kBandInSpacings * spacing) return std::pair(std::move(slab), spacing);
  }
  return fail(ErrorCode::kInvalidInput, "too few points lie near the tape plane",
              "give control points on the body, or a denser cloud");
}

/// Leaves out points that are far from all others, compared with their neighbours.
PlaneSlab without_strays(const PlaneSlab& slab) {
  const PointIndex index(slab.places);
  std::vector<std::vector<PointIndex::Neighbour>> nearest;
  std::vector<double> spacings;
  nearest.reserve(slab.places.size());
  spacings.reserve(slab.places.size());
  for (const auto& place : slab.places) {
    nearest.push_back(index.nearest(place, kSpacingNeighbours + 1));
    spacings.push_back(own_spacing(nearest.back()));
  }
  PlaneSlab kept;
  std::vector<double> around;
  for (std::size_t i = 0; i < slab.places.size(); ++i) {
    around.clear();
    for (const auto& neighbour : nearest[i]) around.push_back(spacings[neighbour.index]);
    if (spacings[i] > kStrayRatio * median(around)) continue;
    kept.indices.push_back(slab.indices[i]);
    kept.places.push_back(slab.places[i]);
  }
  return kept;
}

/// Outward normal of a point of the cloud in the plane's frame, where the cloud knows it.
Eigen::Vector3d known_direction(const std::vector<Eigen::Vector3d>& directions,
                                const TapePlane& plane, std::size_t index) {
  const Eigen::Vector3d& direction = directions[index];
  return {plane.u().dot(direction), plane.v().dot(direction), plane.normal().dot(direction)};
}

/// Averages points within `reach` of each other, unless their known normals face apart. Weights are
/// those of the variances, so that a platform point does not outvote a seen one.
void average(const PointCloud& cloud, const TapePlane& plane, const PlaneSlab& slab, double reach,
             double sigma_mm, bool use_own_sigma, PlaneBand& band,
             std::vector<Eigen::Vector3d>& views) {
  const PointIndex index(slab.places);
  std::vector<bool> taken(slab.places.size(), false);
  for (std::size_t i = 0; i < slab.places.size(); ++i) {
    if (taken[i]) continue;
    OrientedPoint mean{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.0};
    Eigen::Vector3d view = Eigen::Vector3d::Zero();
    double weights = 0.0;
    bool seen = false;
    for (const auto& neighbour : index.within(slab.places[i], reach)) {
      const std::size_t k = neighbour.index;
      const std::size_t point = slab.indices[k];
      if (taken[k]) continue;
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      if (cloud.has_normals()) {
        normal = known_direction(cloud.normals, plane, point);
        if (normal.dot(mean.normal) < 0.0) continue;
      }
      taken[k] = true;
      const double sigma = use_own_sigma ? cloud.sigma_mm[point] : sigma_mm;
      const double weight = 1.0 / std::max(sigma * sigma, 1e-300);
      mean.position += weight * slab.places[k];
      mean.normal += weight * normal;
      if (!cloud.view_directions.empty()) {
        view += known_direction(cloud.view_directions, plane, point);
      }
      weights += weight;
      seen = seen || cloud.was_seen(point);
    }
    mean.position /= weights;
    mean.normal.normalize();
    mean.variance = 1.0 / weights;
    band.points.push_back(mean);
    band.seen.push_back(seen);
    views.push_back(view);
  }
}

/// As many neighbours as reach beyond the noise, or a normal would be one of noise.
std::size_t normal_points(const PlaneBand& band) {
  const double reach = kNormalReachInSigmas * band.sigma / band.spacing;
  return std::clamp(static_cast<std::size_t>(std::numbers::pi * reach * reach), kFewestNormalPoints,
                    kMostNormalPoints);
}

void find_normals(const PointCloud& cloud, const std::vector<Eigen::Vector3d>& views,
                  PlaneBand& band) {
  if (cloud.has_normals()) return;
  std::vector<Eigen::Vector3d> places;
  for (const auto& point : band.points) places.push_back(point.position);
  const PointIndex index(places);
  auto normals = estimate_normals(places, index, normal_points(band));
  if (cloud.view_directions.empty()) {
    orient_by_neighbours(places, index, normals);
  } else {
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (normals[i].dot(views[i]) < 0.0) normals[i] *= -1.0;
    }
  }
  for (std::size_t i = 0; i < normals.size(); ++i) band.points[i].normal = normals[i];
}

/// Moves the band into its own unit, in which the section is about one long.
void normalise(PlaneBand& band) {
  Eigen::AlignedBox2d box;
  for (const auto& point : band.points) box.extend(point.position.head<2>().eval());
  band.unit_mm = box.diagonal().norm();
  band.middle_mm = box.center();
  const Eigen::Vector3d centre(band.middle_mm.x(), band.middle_mm.y(), 0.0);
  for (auto& point : band.points) {
    point.position = (point.position - centre) / band.unit_mm;
    point.variance /= band.unit_mm * band.unit_mm;
  }
  band.spacing /= band.unit_mm;
  band.sigma /= band.unit_mm;
  for (auto& local : band.roughness) {
    local.place = (local.place - centre) / band.unit_mm;
    local.roughness *= band.unit_mm;
  }
}

/// Points next to the plane, in the order in which they lie round the middle.
std::vector<std::size_t> along_the_plane(const PlaneSlab& slab, double spacing) {
  Eigen::AlignedBox3d box;
  for (const auto& place : slab.places) box.extend(place);
  std::vector<std::pair<double, std::size_t>> angles;
  for (std::size_t i = 0; i < slab.places.size(); ++i) {
    if (std::abs(slab.places[i].z()) > 1.5 * spacing) continue;
    const Eigen::Vector3d arm = slab.places[i] - box.center();
    angles.emplace_back(std::atan2(arm.y(), arm.x()), i);
  }
  std::sort(angles.begin(), angles.end());
  std::vector<std::size_t> indices;
  for (const auto& [angle, index] : angles) indices.push_back(index);
  return indices;
}

bool lies_on_both_sides(const PlaneSlab& slab) {
  const auto above = std::count_if(slab.places.begin(), slab.places.end(),
                                   [](const auto& place) { return place.z() > 0.0; });
  const auto count = static_cast<std::ptrdiff_t>(slab.places.size());
  return above * 20 > count && (count - above) * 20 > count;
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
  auto found = wide_enough_slab(cloud, plane);
  if (!found) return tl::make_unexpected(found.error());
  PlaneSlab slab = without_strays(found->first);
  double spacing = found->second;
  if (slab.places.size() < kFewestPoints || !(spacing > 0.0)) return no_surface();

  PlaneBand band;
  const bool own_sigma = !sigma_mm && cloud.has_sigma();
  if (own_sigma) {
    std::vector<double> sigmas;
    for (const std::size_t index : slab.indices) sigmas.push_back(cloud.sigma_mm[index]);
    sigma_mm = median(sigmas);
  }
  const NoiseEstimate noise = estimate_noise(slab.places, PointIndex(slab.places),
                                             along_the_plane(slab, spacing), sigma_mm);
  band.sigma = noise.sigma;
  band.roughness = noise.roughness;

  Eigen::AlignedBox3d box;
  for (const auto& place : slab.places) box.extend(place);
  const double size = box.diagonal().norm();
  double crowd = std::min(kAveragedSigmas * noise.sigma, kWidestAverage * size);
  if (spacing < kFinest * size) crowd = std::max(crowd, kFinest * size);
  if (crowd > spacing) {
    spacing = crowd;
    slab = without_strays(slab_of(cloud, plane, kBandInSpacings * spacing));
  }
  if (!lies_on_both_sides(slab)) {
    return fail(ErrorCode::kInvalidInput, "the tape plane only touches the body",
                "give control points that cut the body");
  }
  band.spacing = spacing;
  band.used = slab.indices.size();
  std::vector<Eigen::Vector3d> views;
  average(cloud, plane, slab, std::max(0.5 * crowd, kDuplicate * spacing),
          std::max(noise.sigma, 1e-9 * spacing), own_sigma, band, views);
  find_normals(cloud, views, band);
  normalise(band);
  if (!(band.unit_mm > 0.0)) return no_surface();
  return band;
}

}  // namespace instep
