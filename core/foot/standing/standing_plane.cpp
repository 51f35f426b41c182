#include "core/foot/standing/standing_plane.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/geometry/moments.h"
#include "core/geometry/place_hash.h"
#include "core/geometry/point_index.h"
#include "core/geometry/polygon.h"
#include "core/median.h"
#include "core/picked.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kStrayShare = 5e-4;
constexpr double kSmallestSupportMm2 = 2500.0;
constexpr double kClearlyLarger = 1.25;
constexpr std::size_t kSample = 4000;      ///< points that candidates are compared by
constexpr std::size_t kNormalPlaces = 80;  ///< at which the surface's normal is tried
constexpr std::size_t kNeighbours = 16;
constexpr double kTouchesMm = 8.0;  ///< a point this near to the plane touches it
constexpr double kRestsMm = 4.0;    ///< a point this near may be of a flat face that rests on it
constexpr double kBorderReachMm = 12.0;  ///< a place of the border is touched by a point so near
constexpr std::size_t kFewestOfSole = 50;
/// Sine of a tilt that is none of the file's: an open sole of noisy points leaves as much in doubt.
constexpr double kOffUpright = 0.006;
constexpr double kLargestTilt = 0.14;
constexpr double kFlatShare = 0.5;  ///< of the support that a closed sole covers

/// Points that touch a plane, seen along its normal.
std::vector<Vector2d> touching(const Points& points, const StandingPlane& plane, double thickness) {
  const RigidTransform standing = plane.standing_from_input();
  std::vector<Vector2d> flat;
  for (const auto& point : points) {
    if (plane.up.dot(point) - plane.height_mm < thickness) {
      flat.push_back((standing * point).head<2>());
    }
  }
  return flat;
}

double distance_to_nearest(const std::vector<Vector2d>& points, const Vector2d& place) {
  double least = 1e300;
  for (const auto& point : points) least = std::min(least, (point - place).squaredNorm());
  return std::sqrt(least);
}

/// Share of a hull's border, walked in steps, beside which a point lies.
double touched_share(const std::vector<Vector2d>& hull, const std::vector<Vector2d>& points) {
  double touched = 0.0;
  double steps = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d along = hull[(i + 1) % hull.size()] - hull[i];
    const int pieces = 1 + static_cast<int>(along.norm() / kBorderReachMm);
    for (int k = 0; k < pieces; ++k) {
      const Vector2d place = hull[i] + (k + 0.5) / pieces * along;
      const double length = along.norm() / pieces;
      if (distance_to_nearest(points, place) < kBorderReachMm) touched += length;
      steps += length;
    }
  }
  return steps > 0.0 ? touched / steps : 0.0;
}

double support(const Points& sample, const StandingPlane& plane, double thickness) {
  const auto points = touching(sample, plane, thickness);
  const auto hull = convex_hull(points);
  if (hull.size() < 3) return 0.0;
  return std::abs(signed_area(hull)) * std::pow(touched_share(hull, points), 2);
}

/// The plane of a set of points by least squares, its normal on the side of `up`.
std::pair<Vector3d, double> fitted_plane(const Points& points, const Vector3d& up) {
  Moments moments;
  for (const auto& point : points) moments.add(point - points.front());
  Vector3d normal = moments.flattest();
  if (normal.dot(up) < 0.0) normal = -normal;
  return {normal, normal.dot(points.front() + moments.middle())};
}

/// The plane by what touches it, as it lies.
StandingPlane laid_on_touching(const Points& sample, const StandingPlane& plane, double thickness) {
  Points low;
  for (const auto& point : sample) {
    if (plane.up.dot(point) - plane.height_mm < thickness) low.push_back(point);
  }
  return low.size() < 3 ? plane : plane_below(sample, fitted_plane(low, plane.up).first);
}

/// Tilts the plane until it fits what touches it.
StandingPlane settled(const Points& sample, StandingPlane plane) {
  for (const double thickness : {kTouchesMm, 0.75 * kTouchesMm, 0.5 * kTouchesMm}) {
    plane = laid_on_touching(sample, plane, thickness);
  }
  return plane;
}

/// Tilts the plane as a body tips until it stands still: from one end of an open sole, along which
/// no surface lies, to the whole of it.
StandingPlane tipped(const Points& sample, StandingPlane plane) {
  constexpr int kMostSteps = 30;
  constexpr double kStill = 1e-3;
  for (const double thickness : {kTouchesMm, 0.5 * kTouchesMm, 0.25 * kTouchesMm}) {
    for (int step = 0; step < kMostSteps; ++step) {
      const StandingPlane next = laid_on_touching(sample, plane, thickness);
      const bool is_still = next.up.cross(plane.up).norm() < kStill;
      plane = next;
      if (is_still) break;
    }
  }
  return plane;
}

/// Normals of the surface at places spread over the sample, on both sides.
Points surface_directions(const Points& sample) {
  const PointIndex index(sample);
  Points directions;
  const std::size_t step = sample.size() / kNormalPlaces + 1;
  for (std::size_t i = 0; i < sample.size(); i += step) {
    Points close;
    for (const auto& neighbour : index.nearest(sample[i], kNeighbours)) {
      close.push_back(sample[neighbour.index]);
    }
    const Vector3d normal = fitted_plane(close, Vector3d::UnitZ()).first;
    directions.push_back(normal);
    directions.push_back(-normal);
  }
  return directions;
}

struct Candidate {
  StandingPlane plane;
  double support = 0.0;
};

void keep_better(Candidate& best, const Points& sample, const StandingPlane& plane,
                 double advantage) {
  const double own = support(sample, plane, kTouchesMm);
  if (own > advantage * best.support) best = {plane, own};
}

/// The candidates among the surface's normals that touch most points, settled.
std::vector<StandingPlane> likely_planes(const Points& sample) {
  constexpr std::size_t kKept = 10;
  std::vector<std::pair<std::size_t, StandingPlane>> rough;
  for (const auto& up : surface_directions(sample)) {
    const StandingPlane plane = plane_below(sample, up);
    rough.emplace_back(touching(sample, plane, kTouchesMm).size(), plane);
  }
  std::stable_sort(rough.begin(), rough.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<StandingPlane> planes;
  for (std::size_t i = 0; i < std::min(kKept, rough.size()); ++i) {
    planes.push_back(settled(sample, rough[i].second));
  }
  return planes;
}

/// Whether points near a plane cover it, rather than only its border.
bool is_closed(const Points& near_plane, const StandingPlane& plane) {
  constexpr double kCellMm = 10.0;
  const auto flat = touching(near_plane, plane, 1e300);
  std::vector<std::pair<double, double>> cells;
  cells.reserve(flat.size());
  for (const auto& point : flat) {
    cells.emplace_back(std::floor(point.x() / kCellMm + 0.5),
                       std::floor(point.y() / kCellMm + 0.5));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  const double area = std::abs(signed_area(convex_hull(flat)));
  return static_cast<double>(cells.size()) * kCellMm * kCellMm > kFlatShare * area;
}

/// Whether a flat face of the body lies on the plane.
bool rests_flat(const Points& sample, const StandingPlane& plane) {
  Points low;
  for (const auto& point : sample) {
    if (plane.up.dot(point) - plane.height_mm < kRestsMm) low.push_back(point);
  }
  return low.size() >= kFewestOfSole && is_closed(low, plane);
}

/// Of planes on which a flat face rests, the one under the largest. A foot's outer side is nearly
/// as long and high as its sole is broad, but round: little of it is within the thickness of a
/// face.
std::optional<StandingPlane> under_largest_face(const Points& sample,
                                                const std::vector<StandingPlane>& planes) {
  std::optional<StandingPlane> best;
  double largest = 0.0;
  for (const auto& plane : planes) {
    const double own = rests_flat(sample, plane) ? support(sample, plane, kRestsMm) : 0.0;
    if (own <= largest) continue;
    largest = own;
    best = plane;
  }
  return best;
}

/// Whether the border of what touches the plane is touched nearly everywhere, as an open sole does.
bool stands_all_round(const Points& sample, const StandingPlane& plane) {
  constexpr double kNearlyAll = 0.75;
  const auto points = touching(sample, plane, kTouchesMm);
  const auto hull = convex_hull(points);
  return hull.size() >= 3 && touched_share(hull, points) > kNearlyAll;
}

/// Tilts a plane to what rests on it: heel and ball, not the toes, of which the undersides may hang
/// a millimetre over the floor. Points over the plane count little.
StandingPlane lowered(const Points& points, StandingPlane plane) {
  constexpr double kThicknessMm = 2.0;
  constexpr double kWeightAbove = 0.08;
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    double weights = 0.0;
    Vector3d mean = Vector3d::Zero();
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    for (const auto& point : points) {
      const double off = plane.up.dot(point) - plane.height_mm;
      if (std::abs(off) > kThicknessMm) continue;
      const double weight = off > 0.0 ? kWeightAbove : 1.0;
      weights += weight;
      mean += weight * point;
      moment += weight * point * point.transpose();
    }
    if (!(weights > 0.0)) return plane;
    mean /= weights;
    const Eigen::Matrix3d spread = moment / weights - mean * mean.transpose();
    Vector3d up = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
    if (up.dot(plane.up) < 0.0) up = -up;
    plane = {up, up.dot(mean)};
  }
  return plane;
}

/// The height over which most points lie close together: the sole, not what rises from it.
double crowded_height(const Points& points, const StandingPlane& plane) {
  constexpr double kSearchMm = 3.0;
  constexpr double kWindowMm = 0.8;
  std::vector<double> heights;
  for (const auto& point : points) {
    const double height = plane.up.dot(point);
    if (std::abs(height - plane.height_mm) < kSearchMm) heights.push_back(height);
  }
  std::sort(heights.begin(), heights.end());
  std::size_t most = 0;
  double crowded = plane.height_mm;
  for (std::size_t first = 0, past = 0; first < heights.size(); ++first) {
    while (past < heights.size() && heights[past] <= heights[first] + kWindowMm) ++past;
    if (past - first <= most) continue;
    most = past - first;
    crowded = heights[first + (past - first) / 2];
  }
  return crowded;
}

}  // namespace

RigidTransform StandingPlane::standing_from_input() const {
  RigidTransform transform = RigidTransform::Identity();
  transform.linear() = Eigen::Quaterniond::FromTwoVectors(up, Vector3d::UnitZ()).toRotationMatrix();
  transform.translation() = -height_mm * Vector3d::UnitZ();
  return transform;
}

StandingPlane plane_below(const Points& points, const Vector3d& up) {
  std::vector<double> heights;
  heights.reserve(points.size());
  for (const auto& point : points) heights.push_back(up.dot(point));
  return {up, quantile(std::move(heights), kStrayShare)};
}

StandingPlane settled_on_sole(const Points& points, const StandingPlane& plane) {
  StandingPlane sole = plane;
  double checked = 0.0;  // a thickness is tried again only to settle
  // What stands up from a flat sole, its rim and arch, goes step by step.
  for (const double thickness : {6.0, 4.0, 2.5, 1.5, 1.5, 1.5}) {
    Points near_plane;
    for (const auto& point : points) {
      if (std::abs(sole.up.dot(point) - sole.height_mm) < thickness) near_plane.push_back(point);
    }
    if (near_plane.size() < kFewestOfSole) return plane;
    if (thickness != checked && !is_closed(near_plane, sole)) return plane;
    checked = thickness;
    const auto [up, height] = fitted_plane(near_plane, plane.up);
    if (up.cross(plane.up).norm() > kLargestTilt) return plane;
    sole = {up, height};
  }
  sole = lowered(points, sole);
  return {sole.up, crowded_height(points, sole)};
}

Result<StandingPlane> find_standing_plane(const Points& points) {
  const Points sample = picked(points, some_by_place(points, kSample));
  Candidate best;
  // z up is the habit of files, so it is tried first and wins a tie, even if it is somewhat off.
  const StandingPlane upright = tipped(sample, plane_below(sample, Vector3d::UnitZ()));
  const bool is_off = upright.up.cross(Vector3d::UnitZ()).norm() > kOffUpright;
  if (is_off && stands_all_round(sample, upright)) keep_better(best, sample, upright, 1.0);
  for (const int axis : {2, 1, 0}) {
    for (const double sign : {1.0, -1.0}) {
      const StandingPlane plane = plane_below(sample, sign * Vector3d::Unit(axis));
      const bool is_habit = axis == 2 && sign > 0.0;
      if (is_habit || rests_flat(sample, plane) || stands_all_round(sample, plane)) {
        keep_better(best, sample, plane, is_habit ? 1.0 : kClearlyLarger);
      }
    }
  }
  if (const auto plane = under_largest_face(sample, likely_planes(sample))) {
    keep_better(best, sample, *plane, kClearlyLarger);
  }
  if (best.support < kSmallestSupportMm2) {
    return fail(ErrorCode::kInvalidInput, "the cloud has no flat support as large as a foot's",
                "measure one whole foot, in millimetres");
  }
  const bool is_tipped = is_off && best.plane.up == upright.up;
  const Vector3d up = is_tipped ? tipped(points, best.plane).up : best.plane.up;
  return settled_on_sole(points, plane_below(points, up));
}

}  // namespace instep
