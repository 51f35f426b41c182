#include "core/foot/axis/outline_axis.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "core/foot/skin/robust_extreme.h"
#include "core/geometry/extent.h"
#include "core/geometry/plane_vectors.h"
#include "core/geometry/polygon.h"
#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kShortestFootMm = 120.0;
constexpr double kLongestFootMm = 360.0;
constexpr double kFirstOutlineHeightMm = 40.0;
constexpr double kNarrowestShare = 0.26;  ///< breadth of the outline over its length
constexpr double kBroadestShare = 0.58;
constexpr double kHighestToeShare = 0.18;    ///< height at the toes' end over the length
constexpr double kLowestInstepShare = 0.18;  ///< height in the rear half over the length
constexpr double kEndShare = 0.08;
constexpr double kStrayShare = 0.02;

const char* const kAdvice =
    "measure one whole foot that stands on its sole, in millimetres, without the floor, a wall or "
    "another foot round it, nor most of a leg on it";

tl::unexpected<Error> no_foot(const std::string& what, const std::string& advice = kAdvice) {
  return fail(ErrorCode::kInvalidInput, "this is not a foot: " + what, advice);
}

std::string rounded(double value) {
  return std::to_string(std::lround(value)) + " mm";
}

Points lower_than(const Points& points, double height) {
  Points low;
  for (const auto& point : points) {
    if (point.z() <= height) low.push_back(point);
  }
  return low;
}

std::vector<Vector2d> hull_from_above(const Points& points) {
  std::vector<Vector2d> flat;
  flat.reserve(points.size());
  for (const auto& point : points) flat.push_back(point.head<2>());
  return convex_hull(std::move(flat));
}

/// Direction of the longer principal axis of a polygon's area.
Vector2d long_axis(const std::vector<Vector2d>& polygon) {
  double area = 0.0;
  Vector2d first = Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  const Vector2d anchor = polygon.front();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vector2d a = polygon[i] - anchor;
    const Vector2d b = polygon[i + 1] - anchor;
    const double twice = cross(a, b);
    const Vector2d sum = a + b;
    area += twice / 2.0;
    first += twice / 6.0 * sum;
    second += twice / 24.0 * (a * a.transpose() + b * b.transpose() + sum * sum.transpose());
  }
  const Eigen::Matrix2d spread = second - first * first.transpose() / area;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(1);
}

/// Without strays.
Extent robust_extent(const Points& points, const Vector2d& direction) {
  const Vector3d along(direction.x(), direction.y(), 0.0);
  return {along.dot(robust_extreme(points, -along)), along.dot(robust_extreme(points, along))};
}

/// Height under which all but a few strays lie, of the points that `chosen` picks.
template <typename Chooser>
double height_of(const Points& points, const Chooser& chosen) {
  std::vector<double> heights;
  for (const auto& point : points) {
    if (chosen(point)) heights.push_back(point.z());
  }
  return quantile(std::move(heights), 1.0 - kStrayShare);
}

Result<void> check_size(const Extent& along, const Extent& across) {
  if (!(along.length() >= kShortestFootMm && along.length() <= kLongestFootMm)) {
    return no_foot("it is " + rounded(along.length()) + " long");
  }
  const double share = across.length() / along.length();
  if (!(share >= kNarrowestShare && share <= kBroadestShare)) {
    return no_foot("it is " + rounded(across.length()) + " broad on a length of " +
                   rounded(along.length()));
  }
  return {};
}

Result<void> check_heights(const Points& points, const Vector2d& forward, double rear,
                           double length) {
  const double toes = height_of(points, [&](const Vector3d& point) {
    return forward.dot(point.head<2>()) - rear > (1.0 - kEndShare) * length;
  });
  if (toes > kHighestToeShare * length) {
    return no_foot("both its ends are higher than toes (" + rounded(toes) + " at the lower end)",
                   std::string(kAdvice) + "; turn a last so that z points up");
  }
  const double instep = height_of(points, [&](const Vector3d& point) {
    const double place = forward.dot(point.head<2>()) - rear;
    return place > 0.1 * length && place < 0.5 * length;
  });
  if (instep < kLowestInstepShare * length) {
    return no_foot("it is only " + rounded(instep) + " high where the instep should be");
  }
  return {};
}

}  // namespace

RigidTransform OutlineAxis::axis_from_standing() const {
  RigidTransform transform = RigidTransform::Identity();
  transform.linear().topLeftCorner<2, 2>() << forward.x(), forward.y(), -forward.y(), forward.x();
  transform.translation().head<2>() = -(transform.linear().topLeftCorner<2, 2>() * heel);
  return transform;
}

std::optional<Vector2d> long_direction(const Points& points) {
  const auto hull = hull_from_above(points);
  return hull.size() < 3 ? std::nullopt : std::optional(long_axis(hull));
}

Result<OutlineAxis> find_outline_axis(const Points& points) {
  const Points low = lower_than(points, kFirstOutlineHeightMm);
  const auto direction = long_direction(low);
  if (!direction) return no_foot("nothing of it is near the floor");
  Vector2d forward = *direction;
  Extent along = robust_extent(low, forward);
  const Vector2d across(-forward.y(), forward.x());
  const Extent breadth = robust_extent(low, across);
  if (auto checked = check_size(along, breadth); !checked) return tl::unexpected(checked.error());

  const double quarter = 0.25 * along.length();
  const double at_start = height_of(points, [&](const Vector3d& point) {
    return forward.dot(point.head<2>()) < along.from + quarter;
  });
  const double at_end = height_of(points, [&](const Vector3d& point) {
    return forward.dot(point.head<2>()) > along.to - quarter;
  });
  if (at_end > at_start) {
    forward = -forward;
    along = {-along.to, -along.from};
  }
  if (auto checked = check_heights(points, forward, along.from, along.length()); !checked) {
    return tl::unexpected(checked.error());
  }
  const double middle = (breadth.from + breadth.to) / 2.0;
  return OutlineAxis{along.from * forward + middle * across, forward, along.length()};
}

}  // namespace instep
