#include "core/foot/measures/hidden_skin.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/fusion/sole/close_sole.h"
#include "core/fusion/sole/wall_foot.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kOverFloorMm = 0.3;
// Set by eye, as all that follows but for the last.
/// As far from its lower end a wall is taken to be as it was seen.
constexpr double kBorderMm = 2.5;
/// A stretch that ends higher does not run down to the floor.
constexpr double kDownMm = 3.0;
/// As far back along the wall its direction is taken.
constexpr double kWallMm = 4.0;
/// Less steep a plane is level, as round the ankle: it meets no floor.
constexpr double kLeastUpright = 0.1;
/// A wall that leans inwards by so much a millimetre down is in its bend, which goes on.
constexpr double kBending = 0.5;
/// A wall that was lost high meets the floor so much further in, but for where the sole's edge is
/// round, even where it is taken to stand right over it.
constexpr double kMostInsetMm = 15.0;
/// Of the range of hidden_range(). Cut off by so much at the ball or the waist, 24 simulated feet
/// err by less than 0.33 of it (19 girths of 20), two scanned ones by up to 0.57 (9 of 10).
constexpr double kRangeShare = 0.6;

/// Of each corner of the section: over the floor, and far from all that was seen.
std::vector<bool> hidden_corners(const SeenSkin& seen, const TapePlane& plane,
                                 const std::vector<Vector2d>& contour) {
  std::vector<bool> is_hidden;
  for (const auto& corner : contour) {
    const Vector3d place = plane.lift(corner);
    is_hidden.push_back(place.z() > kOverFloorMm && !seen.is_near(place));
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
  const std::size_t seen_last = back_along_wall(runs_down ? first : last % count, kBorderMm);
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

/// Between the tape of a wall that goes on as it was seen last, but no further outwards, and bends
/// at the floor only, and a tape straight across; less where the wall has begun to bend.
double hidden_range(const Stretch& stretch, const Vector2d& middle, const Vector2d& up) {
  const Vector2d level(up.y(), -up.x());
  const Vector2d way = stretch.course.back() - stretch.course.front();
  const double sign = level.dot(middle - stretch.course.front()) > 0.0 ? 1.0 : -1.0;
  const double height = -up.dot(way);
  const double inset = std::min(kMostInsetMm, height - WallSettings{}.usual_edge_mm);
  const double breadth = std::max({0.0, sign * level.dot(way), inset});
  const double falls = -up.dot(stretch.wall);
  const double leans = std::max(0.0, sign * level.dot(stretch.wall));
  const bool is_bending = leans > 0.0 && leans >= kBending * falls;
  if (!(height > 0.0) || is_bending) return 0.0;
  // What still rises where it ends, and leads outwards, may come down upright.
  const double slope = leans > 0.0 ? leans / falls : 0.0;
  const double corner = std::hypot(height, slope * height) + std::abs(breadth - slope * height);
  return (1.0 - slope / kBending) * std::max(0.0, corner - std::hypot(height, breadth));
}

/// By how much the arc in which a sole's edge comes down the last millimetres to the floor is
/// longer than what is level of its chord.
double longer_round_edge(double height_mm) {
  constexpr double kEdgeMm = 12.0;  // its radius, as girths of two real feet tell
  const double turn = std::acos(1.0 - std::min(height_mm / kEdgeMm, 1.0));
  return kEdgeMm * (turn - std::sin(turn));
}

}  // namespace

double doubt_of_guessed_skin(const PointCloud& cloud, const TapePlane& plane) {
  // So do ball, waist and instep of drawn feet without soles hold alike (tests/bench/feet --open);
  // a share of the length would be too little for the ball's where it is enough for the waist's.
  constexpr double kPieceMm = 10.0;
  constexpr double kDoubtOfPieceMm = 0.5;
  constexpr double kBandMm = 2.0;
  const double spacing = SoleSettings{}.spacing_mm;
  double points = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool is_guessed = !cloud.was_seen(i) && cloud.positions[i].z() > kOverFloorMm &&
                            std::abs(plane.distance(cloud.positions[i])) < kBandMm;
    if (is_guessed) points += 1.0;
  }
  const double length = points * spacing * spacing / (2.0 * kBandMm);
  return kDoubtOfPieceMm * std::sqrt(length / kPieceMm);
}

HiddenWall hidden_wall(const SeenSkin& seen, const TapePlane& plane, const Girth& girth) {
  HiddenWall hidden;
  const Vector2d upwards(plane.u().z(), plane.v().z());
  if (!(upwards.norm() > kLeastUpright)) return hidden;
  const Vector2d up = upwards.normalized();
  const auto is_hidden = hidden_corners(seen, plane, girth.contour);
  Vector2d middle = Vector2d::Zero();
  for (const auto& corner : girth.contour) middle += corner;
  middle /= static_cast<double>(std::max<std::size_t>(1, girth.contour.size()));
  for (const auto& stretch : hidden_stretches(girth.contour, is_hidden, up)) {
    if (plane.lift(stretch.course.back()).z() > kDownMm) continue;
    const double doubt = kRangeShare * hidden_range(stretch, middle, up);
    if (!(doubt > 0.0)) continue;
    hidden.doubt_mm += doubt;
    hidden.height_mm = std::max(hidden.height_mm, plane.lift(stretch.course.front()).z());
  }
  double top = 0.0;
  for (const auto& corner : girth.contour) top = std::max(top, plane.lift(corner).z());
  if (top > 0.0) hidden.share = hidden.height_mm / top;
  return hidden;
}

double doubt_of_deeper_sole(const FloorBelow& floor, const TapePlane& plane, const Girth& girth) {
  const bool passes_under =
      std::any_of(girth.contour.begin(), girth.contour.end(),
                  [&](const Vector2d& corner) { return plane.lift(corner).z() < floor.u95_mm; });
  if (!passes_under) return 0.0;
  return 2.0 *
         (longer_round_edge(floor.depth_mm + floor.u95_mm) - longer_round_edge(floor.depth_mm));
}

}  // namespace instep
