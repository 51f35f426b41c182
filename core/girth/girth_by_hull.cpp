#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/geometry/polygon.h"
#include "core/girth/band/plane_heights.h"
#include "core/girth/band/plane_slab.h"
#include "core/girth/contour/contour_index.h"
#include "core/girth/contour/section_gaps.h"
#include "core/girth/girth.h"
#include "core/girth/refusals.h"
#include "core/in_millimetres.h"

namespace instep {
namespace {

/// Half-width of the band: half a spacing, so that about one row of points is in it. A band that
/// holds fewer points is widened; one that is this many spacings wide and still holds fewer tells
/// that the plane misses the cloud.
constexpr std::size_t kFewestBandPoints = 10;
constexpr double kNarrowestBandInSpacings = 0.5;
constexpr double kWidestBandInSpacings = 4.0;

/// Part of the cloud's size at which the neighbourhood begins to be widened.
constexpr double kThinnest = 1e-4;
/// How much longer the hull of twice the band may be, if its width does not matter.
constexpr double kSteadyGrowth = 0.01;
/// Points so deep inside, against the width of the hull, are in a hollow or of another body; and
/// how many of them there have to be.
constexpr double kDeep = 0.05;
constexpr double kManyDeep = 0.02;

/// What lies about the plane, and how far apart its points are.
struct Neighbourhood {
  PlaneSlab slab;
  double spacing = 0.0;
  double tape_about_mm = 0.0;
};

/// Widens the slab until it is wider than any band.
Result<Neighbourhood> neighbourhood_of(const PointCloud& cloud, const TapePlane& plane) {
  const PlaneHeights heights(cloud, plane);
  const double size = heights.size();
  for (double half_width = kThinnest * size; half_width < size; half_width *= 1.4) {
    PlaneSlab slab = slab_of(cloud, plane, half_width, heights);
    if (slab.places.size() < kFewestBandPoints) continue;
    const double spacing = median_nearest_distance(PointIndex(slab.places));
    if (half_width >= kWidestBandInSpacings * spacing) {
      return Neighbourhood{std::move(slab), spacing, tape_about(cloud, plane, size)};
    }
  }
  return too_few_near_plane();
}

/// Half-width of the band in which enough points lie.
double half_width_of_band(const Neighbourhood& about) {
  double half_width = kNarrowestBandInSpacings * about.spacing;
  while (1.25 * half_width <= kWidestBandInSpacings * about.spacing &&
         within(about.slab, half_width).places.size() < kFewestBandPoints) {
    half_width *= 1.25;
  }
  return half_width;
}

/// With sides about as long as each other, to be looked up by: where a hull spans hollows they are
/// long, and of many points near the plane there are many short ones.
ContourIndex index_of(const std::vector<Eigen::Vector2d>& hull) {
  constexpr double kSides = 500.0;
  const double longest = perimeter(hull) / kSides;
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d side = hull[(i + 1) % hull.size()] - hull[i];
    const bool is_near = !corners.empty() && (hull[i] - corners.back()).norm() < 0.5 * longest;
    if (is_near && side.norm() < longest) continue;
    const double pieces = std::max(1.0, std::ceil(side.norm() / longest));
    for (double k = 0.0; k < pieces; k += 1.0) corners.emplace_back(hull[i] + k / pieces * side);
  }
  return ContourIndex(std::move(corners));
}

/// Of the points that the hull was drawn round.
bool has_many_inside(const ContourIndex& hull, const std::vector<Eigen::Vector2d>& points) {
  const double deep = kDeep * hull.length() / std::numbers::pi;
  const auto inside = std::count_if(points.begin(), points.end(), [&](const auto& point) {
    return !hull.passes_within(deep, point);
  });
  return static_cast<double>(inside) > kManyDeep * static_cast<double>(points.size());
}

void warn(double length_of_twice, double gap, bool are_many_inside, Girth& girth) {
  girth.warnings.push_back("a hull of points knows no skin: contact is given as stretched");
  if (gap > kNotableGapOfHull * girth.stretched_mm) {
    girth.warnings.emplace_back(kBridgedWarning);
  }
  if (length_of_twice > (1.0 + kSteadyGrowth) * girth.stretched_mm) {
    girth.warnings.push_back("the hull of the points up to twice as far from the plane is " +
                             in_millimetres(length_of_twice - girth.stretched_mm) +
                             " longer: they are few, or the skin leans");
  }
  if (are_many_inside) {
    girth.warnings.push_back(
        "points lie deep inside their hull, which bridges hollows or goes round stray points or "
        "more than one body");
  }
}

}  // namespace

Result<Girth> girth_by_hull(const PointCloud& cloud, const TapePlane& plane,
                            const GirthOptions& options) {
  if (auto sound = check_cloud(cloud); !sound) return tl::make_unexpected(sound.error());
  if (auto sound = check_options(options); !sound) return tl::make_unexpected(sound.error());
  const auto about = neighbourhood_of(cloud, plane);
  if (!about) return tl::make_unexpected(about.error());
  if (!is_cut(about->slab.places)) return only_touched();
  const double half_width = half_width_of_band(*about);
  const PlaneSlab band = within(about->slab, half_width);
  Girth girth;
  girth.contour = hull_of(band);
  const double length = perimeter(girth.contour);
  if (!is_ring(girth.contour) || is_round_a_crowd(length, about->tape_about_mm)) {
    return fail(ErrorCode::kInsufficientData, "the points at the tape plane form no ring",
                "give control points on the body, or leave out points that repeat each other");
  }
  std::vector<Eigen::Vector2d> points, seen;
  for (std::size_t i = 0; i < band.places.size(); ++i) {
    points.emplace_back(band.places[i].head<2>());
    if (cloud.was_seen(band.indices[i])) seen.push_back(points.back());
  }
  const ContourIndex hull = index_of(girth.contour);
  const double gap = largest_gap(hull, points);
  if (gap > kWidestBridge * length) {
    return fail(ErrorCode::kInsufficientData,
                "more than a quarter of the hull at the tape plane has no points",
                "scan the body all round, or use --method rbf");
  }
  girth.stretched_mm = girth.contact_mm = length;
  girth.points = cloud.size();
  girth.band_points = band.places.size();
  girth.largest_gap_mm = largest_gap(hull, seen);
  warn(perimeter(hull_of(within(about->slab, 2.0 * half_width))), gap,
       has_many_inside(hull, points), girth);
  return girth;
}

}  // namespace instep
