#include "core/foot/hidden_skin.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/fusion/close_sole.h"
#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBandMm = 2.0;
constexpr double kOverFloorMm = 0.3;
/// Further from all seen points a corner of the section was not seen; where these lie further apart
/// than they do in a scan, as many times further, and by a band that is as many times wider.
constexpr double kUnseenMm = 2.5;
constexpr double kSpacingMm = 1.5;
constexpr std::size_t kSpacingSample = 200;
/// A stretch that ends higher does not run down to the floor.
constexpr double kDownMm = 3.0;
/// As far back along the wall its direction is taken.
constexpr double kWallMm = 4.0;
/// A wall that leans inwards by so much a millimetre down is in its bend, which goes on.
constexpr double kBending = 0.5;
/// Of what a corner at the floor would add. Where that is more than 5 mm, the ball girths of 20
/// pairs of simulated feet are short by 0.37 to 0.8 of it, three of 23 by 0.9 to 1.2; the waist
/// girths by -0.15 to 0.69.
constexpr double kCornerShare = 0.75;

/// The seen points of a cloud, and how many times further apart they are than usual.
struct SeenPoints {
  std::vector<Vector3d> positions;
  double sparse = 1.0;
};

SeenPoints seen_points(const PointCloud& cloud) {
  SeenPoints seen;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.was_seen(i)) seen.positions.push_back(cloud.positions[i]);
  }
  if (seen.positions.empty()) return seen;
  const double spacing = usual_spacing(PointIndex(seen.positions), kSpacingSample);
  seen.sparse = std::max(1.0, spacing / kSpacingMm);
  return seen;
}

std::vector<Vector2d> near_plane(const SeenPoints& seen, const TapePlane& plane) {
  std::vector<Vector2d> near;
  for (const auto& point : seen.positions) {
    if (std::abs(plane.distance(point)) < kBandMm * seen.sparse) {
      near.push_back(plane.project(point));
    }
  }
  return near;
}

/// Of each corner of the section: over the floor, and far from all that was seen.
std::vector<bool> hidden_corners(const PointCloud& cloud, const TapePlane& plane,
                                 const std::vector<Vector2d>& contour) {
  const SeenPoints seen = seen_points(cloud);
  const auto near = near_plane(seen, plane);
  const double reach = kUnseenMm * seen.sparse;
  std::vector<bool> is_hidden;
  for (const auto& corner : contour) {
    const bool is_seen = std::any_of(near.begin(), near.end(), [&](const Vector2d& point) {
      return (point - corner).squaredNorm() < reach * reach;
    });
    is_hidden.push_back(!is_seen && plane.lift(corner).z() > kOverFloorMm);
  }
  return is_hidden;
}

/// A stretch of the section that was not seen.
struct Stretch {
  std::vector<Vector2d> course;  ///< from its upper end to its lower one
  Vector2d wall;                 ///< the last of the way along the section that was seen before
};

/// From `first` to `last`, which may lie beyond the end of the list by one round.
Stretch stretch_of(const std::vector<Vector2d>& contour, std::size_t first, std::size_t last,
                   const Vector2d& up) {
  const std::size_t count = contour.size();
  Stretch stretch;
  for (std::size_t i = first; i <= last; ++i) stretch.course.push_back(contour[i % count]);
  const bool runs_down = up.dot(stretch.course.front()) > up.dot(stretch.course.back());
  if (!runs_down) std::reverse(stretch.course.begin(), stretch.course.end());
  const auto back_along_wall = [&](std::size_t from, double way_mm) {
    std::size_t at = from;
    for (std::size_t i = 0; i < count && (contour[at] - contour[from]).norm() < way_mm; ++i) {
      at = (at + (runs_down ? count - 1 : 1)) % count;
    }
    return at;
  };
  const std::size_t seen_last = back_along_wall(runs_down ? first : last % count, kUnseenMm);
  stretch.wall = contour[seen_last] - contour[back_along_wall(seen_last, kWallMm)];
  return stretch;
}

std::vector<Stretch> hidden_stretches(const std::vector<Vector2d>& contour,
                                      const std::vector<bool>& is_hidden, const Vector2d& up) {
  const std::size_t count = contour.size();
  std::vector<Stretch> stretches;
  for (std::size_t first = 0; first < count; ++first) {
    if (!is_hidden[first] || is_hidden[(first + count - 1) % count]) continue;
    std::size_t last = first;
    while (is_hidden[(last + 1) % count]) ++last;
    stretches.push_back(stretch_of(contour, first, last, up));
  }
  return stretches;
}

/// By how much it would be longer if the wall went on as it was seen last, but no further outwards,
/// and bent at the floor only; less where the wall has begun to bend.
double longer_by_corner(const Stretch& stretch, const Vector2d& up) {
  const Vector2d level(up.y(), -up.x());
  const Vector2d way = stretch.course.back() - stretch.course.front();
  const double sign = level.dot(way) > 0.0 ? 1.0 : -1.0;
  const double height = -up.dot(way);
  const double breadth = sign * level.dot(way);
  const double falls = -up.dot(stretch.wall);
  const double leans = std::max(0.0, sign * level.dot(stretch.wall));
  if (!(height > 0.0) || leans >= kBending * falls) return 0.0;
  const double slope = leans / falls;
  const double length = perimeter(convex_hull(stretch.course)) - way.norm();  // as a tape has it
  const double corner = std::hypot(height, slope * height) + std::abs(breadth - slope * height);
  return (1.0 - slope / kBending) * std::max(0.0, corner - length);
}

}  // namespace

double doubt_of_guessed_skin(const PointCloud& cloud, const TapePlane& plane) {
  // As drawn feet without soles have it (tests/bench/feet).
  constexpr double kDoubtShare = 0.035;
  const double spacing = SoleSettings{}.spacing_mm;
  double points = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool is_guessed = !cloud.was_seen(i) && cloud.positions[i].z() > kOverFloorMm &&
                            std::abs(plane.distance(cloud.positions[i])) < kBandMm;
    if (is_guessed) points += 1.0;
  }
  return kDoubtShare * points * spacing * spacing / (2.0 * kBandMm);
}

HiddenWall hidden_wall(const PointCloud& cloud, const TapePlane& plane, const Girth& girth) {
  HiddenWall hidden;
  const Vector2d upwards(plane.u().z(), plane.v().z());
  if (!cloud.stands_on_platform() || !(upwards.norm() > 0.1)) return hidden;
  const Vector2d up = upwards.normalized();
  const auto is_hidden = hidden_corners(cloud, plane, girth.contour);
  for (const auto& stretch : hidden_stretches(girth.contour, is_hidden, up)) {
    if (plane.lift(stretch.course.back()).z() > kDownMm) continue;
    const double doubt = kCornerShare * longer_by_corner(stretch, up);
    if (!(doubt > 0.0)) continue;
    hidden.doubt_mm += doubt;
    hidden.height_mm = std::max(hidden.height_mm, plane.lift(stretch.course.front()).z());
  }
  return hidden;
}

}  // namespace instep
