#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/geometry/polygon.h"
#include "core/geometry/principal_frame.h"
#include "core/girth/band/plane_heights.h"
#include "core/girth/band/plane_slab.h"
#include "core/girth/contour/section_gaps.h"
#include "core/girth/girth.h"
#include "core/girth/refusals.h"
#include "core/mean.h"
#include "core/surface/paper/octree_surface.h"

namespace instep {
namespace {

/// What the paper leaves open, and the choices made here.
///
/// D, the half-width of the band of points that take part, against the spacing of the points.
constexpr double kBandInSpacings = 4.0;
/// K, the neighbours through which the line of step 5 is fitted.
constexpr std::size_t kLineNeighbours = 10;
/// Distance of the off-line points of step 6, against the threshold d of step 2: a tenth of a
/// spanning-tree edge, as the paper has it for off-surface points. Eq. 10 is a straight line
/// through a curved field: five times the distance made its error ten times larger.
constexpr double kOffLine = 0.1;
/// How much the circle of step 4 grows each time.
constexpr double kCircleGrowth = 1.25;
constexpr std::size_t kMostInCircle = 60;

constexpr std::size_t kFewestPoints = 10;
/// About how many points are asked for the spacing.
constexpr std::size_t kSpacingPlaces = 4000;
/// The band is looked for in slabs of this part of the cloud's size, and so many times this much
/// thinner or thicker ones.
constexpr double kUsualSlab = 0.005;
constexpr double kSlabGrowth = 1.4;
constexpr int kThinnerSlabs = 12;
/// The ring is lost where less than this part of the initial points leads to an intersection.
constexpr double kFewestMet = 0.5;
/// A ring this much longer than a tape round all points of S swells where nothing was seen; and
/// what of it is worth a warning.
constexpr double kSwollen = 1.25;
constexpr double kNotableSwelling = 1.05;
/// Contact against stretched length; no foot's is so long.
constexpr double kJumping = 1.2;

/// The paper's point set S: the points near the tape plane, in the plane's frame.
struct PartialCloud {
  PlaneSlab slab;
  double half_width = 0.0;
  double tape_about_mm = 0.0;
};

/// Widens the band until it is as many spacings wide as it has to be.
Result<PartialCloud> partial_cloud(const PointCloud& cloud, const TapePlane& plane) {
  const PlaneHeights heights(cloud, plane);
  const double size = heights.size();
  const double thinnest = kUsualSlab * std::pow(kSlabGrowth, -kThinnerSlabs);
  for (double half_width = thinnest * size; half_width < 0.5 * size; half_width *= kSlabGrowth) {
    const PlaneSlab slab = slab_of(cloud, plane, half_width, heights);
    if (slab.places.size() < kFewestPoints) continue;
    const double wanted = kBandInSpacings * usual_spacing(PointIndex(slab.places), kSpacingPlaces);
    if (!(half_width >= wanted && wanted > 0.0)) continue;
    if (!is_cut(slab.places)) return only_touched();
    return PartialCloud{slab_of(cloud, plane, wanted, heights), wanted,
                        tape_about(cloud, plane, size)};
  }
  return too_few_near_plane();
}

/// Unit normal of the straight line through points in the plane, by total least squares (step 5).
/// Nothing if they do not determine a line.
std::optional<Eigen::Vector2d> line_normal(const std::vector<Eigen::Vector2d>& points) {
  const Eigen::Vector2d mean = mean_of(points);
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& point : points) spread += (point - mean) * (point - mean).transpose();
  if (!(spread.trace() > 0.0)) return std::nullopt;
  const double twice_angle = std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  return Eigen::Vector2d(-std::sin(0.5 * twice_angle), std::cos(0.5 * twice_angle));
}

/// The tape plane's view of the surface of S: steps 1 to 7 of the paper's section 5.
class SectionOfSurface {
 public:
  SectionOfSurface(const OctreeSurface& surface, const RigidTransform& principal_from_plane,
                   double reach)
      : surface_(surface), principal_from_plane_(principal_from_plane), reach_(reach) {
    const RigidTransform plane_from_principal = principal_from_plane.inverse();
    for (const auto& point : surface.points()) {
      const Eigen::Vector3d place = plane_from_principal * point;
      if (std::abs(place.z()) > threshold()) continue;  // steps 1 to 3
      initial_.push_back(point);
      flat_.emplace_back(place.x(), place.y(), 0.0);
    }
  }

  /// Step 2's d.
  double threshold() const { return surface_.longest_edge(); }
  /// Number of initial intersection points, the paper's I.
  std::size_t initial() const { return flat_.size(); }

  /// The exact intersection points, as far as there are any.
  std::vector<Eigen::Vector2d> intersections() const {
    std::vector<Eigen::Vector2d> found;
    const PointIndex index(flat_);
    const double spacing = std::max(median_nearest_distance(index), 1e-3 * threshold());
    for (std::size_t i = 0; i < flat_.size(); ++i) {
      const auto normal = line_normal(circle(index, flat_[i], spacing));
      if (!normal) continue;
      if (const auto place = intersection(i, *normal)) found.push_back(*place);
    }
    return found;
  }

 private:
  /// Step 4: the points in a circle that grows until it holds K of them and the point itself; the
  /// nearest ones of a crowd that is in it from the beginning.
  std::vector<Eigen::Vector2d> circle(const PointIndex& index, const Eigen::Vector3d& centre,
                                      double radius) const {
    const auto nearest = index.nearest(centre, kMostInCircle);
    const auto& last = nearest[std::min(kLineNeighbours + 1, nearest.size()) - 1];
    while (radius * radius < last.squared_distance) radius *= kCircleGrowth;
    std::vector<Eigen::Vector2d> points;
    for (const auto& neighbour : nearest) {
      if (neighbour.squared_distance > radius * radius) break;
      points.emplace_back(flat_[neighbour.index].head<2>());
    }
    return points;
  }

  /// Steps 6 and 7, eq. 10 for the isovalue 0. Both values are those of the leaf in which the
  /// initial point lies, so that none of the jumps between leaves falls between them. Where the
  /// field is level, or the answer lies further away than the band is wide, there is none.
  std::optional<Eigen::Vector2d> intersection(std::size_t i, const Eigen::Vector2d& normal) const {
    const auto leaf = surface_.leaf_at(initial_[i]);
    if (!leaf) return std::nullopt;
    const Eigen::Vector2d place = flat_[i].head<2>();
    const Eigen::Vector2d from = place - kOffLine * threshold() * normal;
    const Eigen::Vector2d to = place + kOffLine * threshold() * normal;
    const double value_from = value(*leaf, from);
    const double value_to = value(*leaf, to);
    const Eigen::Vector2d met = from - value_from * (to - from) / (value_to - value_from);
    if (!met.allFinite() || (met - place).norm() > reach_) return std::nullopt;
    return met;
  }

  double value(std::size_t leaf, const Eigen::Vector2d& place) const {
    return surface_.value_of_leaf(
        leaf, principal_from_plane_ * Eigen::Vector3d(place.x(), place.y(), 0.0));
  }

  const OctreeSurface& surface_;
  const RigidTransform& principal_from_plane_;
  double reach_;
  std::vector<Eigen::Vector3d> initial_;  ///< the paper's I, in the principal frame
  std::vector<Eigen::Vector3d> flat_;     ///< the same, laid on the tape plane
};

/// Points in the order in which they lie round their hull's middle (step 8; the paper does not say
/// how they are ordered).
std::vector<Eigen::Vector2d> ordered_round(const std::vector<Eigen::Vector2d>& hull,
                                           std::vector<Eigen::Vector2d> points) {
  const Eigen::Vector2d middle = mean_of(hull);
  const auto angle = [&](const Eigen::Vector2d& point) {
    return std::atan2(point.y() - middle.y(), point.x() - middle.x());
  };
  std::stable_sort(points.begin(), points.end(),
                   [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
  return points;
}

/// Where the seen points near the plane lie on it.
std::vector<Eigen::Vector2d> seen_within(const PointCloud& cloud, const PlaneSlab& slab,
                                         double distance) {
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < slab.places.size(); ++i) {
    if (cloud.was_seen(slab.indices[i]) && std::abs(slab.places[i].z()) <= distance) {
      places.emplace_back(slab.places[i].head<2>());
    }
  }
  return places;
}

tl::unexpected<Error> ring_lost() {
  return fail(ErrorCode::kInsufficientData,
              "the paper's method lost the ring: its surface is torn at the tape plane",
              "use --method rbf, or give a denser or more even cloud");
}

/// The shortest tape round the intersections, against what else is known of the ring.
struct Ring {
  std::vector<Eigen::Vector2d> hull;
  double length = 0.0;
  double gap = 0.0;               ///< longest part without an intersection
  double round_the_points = 0.0;  ///< tape round all points of S
};

bool is_lost(const Ring& ring, const PartialCloud& part) {
  return !is_ring(ring.hull) || ring.gap > kWidestBridge * ring.length ||
         is_round_a_crowd(ring.length, part.tape_about_mm) ||
         ring.length > kSwollen * ring.round_the_points;
}

void warn(const Ring& ring, std::size_t initial, std::size_t met, Girth& girth) {
  girth.warnings.push_back("the paper's method takes noise for shape: for a girth use rbf");
  if (met < initial) {
    girth.warnings.push_back("eq. 10 found no intersection for " + std::to_string(initial - met) +
                             " of " + std::to_string(initial) + " points");
  }
  if (ring.length > kNotableSwelling * ring.round_the_points) {
    girth.warnings.push_back("the surface swells beyond all points near the plane");
  }
  if (ring.gap > kNotableGapOfHull * ring.length) {
    girth.warnings.emplace_back(kBridgedWarning);
  }
  if (girth.contact_mm > kJumping * girth.stretched_mm) {
    girth.warnings.push_back(
        "the contact length jumps to and fro: there are stray points, noise, hollows or more than "
        "one body, which the paper's method takes for one ring");
  }
}

}  // namespace

Result<Girth> girth_by_paper(const PointCloud& cloud, const TapePlane& plane,
                             const GirthOptions& options) {
  if (auto sound = check_cloud(cloud); !sound) return tl::make_unexpected(sound.error());
  if (auto sound = check_options(options); !sound) return tl::make_unexpected(sound.error());
  const auto part = partial_cloud(cloud, plane);
  if (!part) return tl::make_unexpected(part.error());
  const RigidTransform principal = principal_from_input(part->slab.places);
  std::vector<Eigen::Vector3d> turned;
  for (const auto& place : part->slab.places) turned.emplace_back(principal * place);
  const auto surface = OctreeSurface::reconstruct(turned);
  if (!surface) return tl::make_unexpected(surface.error());

  const SectionOfSurface section(*surface, principal, part->half_width);
  const auto met = section.intersections();
  const auto hull = convex_hull(met);
  const Ring ring{hull, perimeter(hull), largest_gap(hull, met), perimeter(hull_of(part->slab))};
  const auto initial = static_cast<double>(section.initial());
  if (static_cast<double>(met.size()) < kFewestMet * initial || is_lost(ring, *part)) {
    return ring_lost();
  }

  Girth girth;
  girth.stretched_mm = ring.length;
  girth.contour = ordered_round(hull, met);
  girth.contact_mm = perimeter(girth.contour);
  girth.points = cloud.size();
  girth.band_points = part->slab.places.size();
  girth.largest_gap_mm = largest_gap(hull, seen_within(cloud, part->slab, section.threshold()));
  warn(ring, section.initial(), met.size(), girth);
  return girth;
}

}  // namespace instep
