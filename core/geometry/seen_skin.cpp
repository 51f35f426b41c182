#include "core/geometry/seen_skin.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/point_spacing.h"
#include "core/picked.h"

namespace instep {
namespace {

constexpr std::size_t kSpacingSample = 200;

std::vector<std::size_t> seen_points(const PointCloud& cloud) {
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.was_seen(i)) seen.push_back(i);
  }
  return seen;
}

}  // namespace

SeenSkin::SeenSkin(const PointCloud& cloud)
    : points_(seen_points(cloud)),
      index_(picked(cloud.positions, points_)),
      spacing_mm_(usual_spacing(index_, kSpacingSample)) {}

std::optional<SeenSkin::Point> SeenSkin::nearest(const Eigen::Vector3d& place) const {
  const auto found = index_.nearest(place, 1);
  if (found.empty()) return std::nullopt;
  return Point{points_[found.front().index], std::sqrt(found.front().squared_distance)};
}

bool SeenSkin::is_near(const Eigen::Vector3d& place) const {
  constexpr double kNearMm = 2.5;  // by eye
  constexpr double kSpacingMm = 1.5;
  const auto point = nearest(place);
  return point && point->distance_mm < kNearMm * std::max(1.0, spacing_mm_ / kSpacingMm);
}

}  // namespace instep
