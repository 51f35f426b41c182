#include <algorithm>
#include <cmath>

#include "core/geometry/distinct_points.h"
#include "core/geometry/point_index.h"
#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "core/girth/section_gaps.h"

namespace instep {
namespace {

/// A band that holds fewer points is widened; one that is this many spacings wide and still holds
/// fewer tells that the plane misses the cloud.
constexpr std::size_t kFewestBandPoints = 10;
constexpr double kWidestBandInSpacings = 4.0;

/// Points whose distance from the plane is at most the half-width. It starts at half a spacing, so
/// that about one row of points is in the band.
std::vector<std::size_t> band(const PointCloud& cloud, const TapePlane& plane, double spacing) {
  std::vector<std::size_t> indices;
  for (double half_width = 0.5 * spacing; half_width <= kWidestBandInSpacings * spacing;
       half_width *= 1.25) {
    indices.clear();
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (std::abs(plane.distance(cloud.positions[i])) <= half_width) indices.push_back(i);
    }
    if (indices.size() >= kFewestBandPoints) return indices;
  }
  indices.clear();
  return indices;
}

}  // namespace

Result<Girth> girth_by_hull(const PointCloud& cloud, const TapePlane& plane,
                            const GirthOptions& options) {
  if (auto sound = check_cloud(cloud); !sound) return tl::make_unexpected(sound.error());
  std::vector<Eigen::Vector3d> places;
  for (const std::size_t i : distinct_points(cloud.positions)) places.push_back(cloud.positions[i]);
  if (places.size() < kFewestBandPoints) {
    return fail(ErrorCode::kInsufficientData, "the cloud has fewer than ten points", "scan again");
  }
  const double spacing = median_spacing(places, PointIndex(places));
  const auto indices = band(cloud, plane, spacing);
  std::vector<Eigen::Vector2d> points, seen;
  for (const std::size_t index : indices) {
    points.push_back(plane.project(cloud.positions[index]));
    if (cloud.was_seen(index)) seen.push_back(points.back());
  }
  Girth girth;
  girth.contour = convex_hull(std::move(points));
  const double length = perimeter(girth.contour);
  if (girth.contour.size() < 3 || !(signed_area(girth.contour) > 1e-6 * length * length)) {
    return fail(ErrorCode::kInvalidInput, "no ring of points lies at the tape plane",
                "give control points on the body");
  }
  girth.stretched_mm = girth.contact_mm = length;
  girth.points = cloud.size();
  girth.band_points = indices.size();
  girth.sigma_mm = options.sigma_mm.value_or(0.0);
  girth.largest_gap_mm = largest_gap(girth.contour, seen);
  girth.warnings.push_back("a hull of points knows no skin: contact is given as stretched");
  return girth;
}

}  // namespace instep
