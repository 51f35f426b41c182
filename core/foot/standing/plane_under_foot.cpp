#include "core/foot/standing/plane_under_foot.h"

#include <cstddef>
#include <optional>

#include "core/foot/axis/outline_axis.h"
#include "core/foot/full_size.h"
#include "core/geometry/extent.h"
#include "core/geometry/moments.h"
#include "core/some_of.h"

namespace instep {
namespace {

constexpr std::size_t kPointsOfLength = 10000;

std::vector<Eigen::Vector3d> scaled(std::vector<Eigen::Vector3d> points, double factor) {
  for (auto& point : points) point *= factor;
  return points;
}

/// Along the direction in which the points spread most.
double longest_extent(const std::vector<Eigen::Vector3d>& points) {
  return extent_along(points, Moments::of(points).longest()).length();
}

/// Of a foot of about that length.
Result<StandingPlane> plane_at_size(const PointCloud& cloud, double length_mm) {
  const double factor = full_size_factor(length_mm);
  return find_standing_plane(scaled(cloud.positions, factor)).map([&](StandingPlane found) {
    found.height_mm /= factor;
    return found;
  });
}

/// Some of its points tell it as well.
std::optional<double> standing_length(const PointCloud& cloud) {
  const PointCloud some = cloud.subset(some_of(cloud.size(), kPointsOfLength));
  const auto plane = plane_at_size(some, longest_extent(some.positions));
  if (!plane) return std::nullopt;
  const auto outline = find_outline_axis(transformed(plane->standing_from_input(), some).positions);
  return outline ? std::optional(outline->length_mm) : std::nullopt;
}

}  // namespace

double rough_length_mm(const PointCloud& cloud) {
  const auto length = standing_length(cloud);
  return length ? *length : longest_extent(cloud.positions);
}

Result<StandingPlane> plane_under_foot(const PointCloud& cloud) {
  return plane_at_size(cloud, rough_length_mm(cloud));
}

StandingPlane plane_again(const std::vector<Eigen::Vector3d>& points, double length_mm) {
  const double factor = full_size_factor(length_mm);
  StandingPlane sole = settled_on_sole(scaled(points, factor), {});
  sole.height_mm /= factor;
  return sole;
}

}  // namespace instep
