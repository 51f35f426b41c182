#include "core/girth/shared_length_doubt.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/geometry/point_index.h"
#include "core/geometry/polygon.h"
#include "core/girth/length_doubt.h"
#include "core/picked.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Skin that hardly meets the plane crosswise moves along it by so many times its error at most.
constexpr double kLeastCrosswise = 0.3;
/// Points so far from the plane, as a share of the line, tell how the skin on it errs.
constexpr double kBesideShare = 0.02;

std::vector<std::size_t> seen_beside(const TapePlane& plane, const PointCloud& cloud,
                                     double half_width) {
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool is_beside = std::abs(plane.distance(cloud.positions[i])) <= half_width;
    if (is_beside && cloud.was_seen(i)) seen.push_back(i);
  }
  return seen;
}

/// The seen points near a plane, with what is known of their errors.
class ErringSkin {
 public:
  ErringSkin(const TapePlane& plane, const PointCloud& cloud, double half_width)
      : plane_(plane),
        cloud_(cloud),
        points_(seen_beside(plane, cloud, half_width)),
        index_(picked(cloud.positions, points_)) {}

  bool empty() const { return points_.empty(); }

  /// How much longer a closed line grows by each of the errors, one sigma.
  std::vector<double> growth_of(const std::vector<Vector2d>& line) const {
    std::vector<double> growth(cloud_.shared_errors_mm.size(), 0.0);
    const std::size_t count = line.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d& corner = line[i];
      const Vector2d turn = (corner - line[(i + count - 1) % count]).normalized() -
                            (line[(i + 1) % count] - corner).normalized();
      const std::size_t point = points_[index_.nearest(plane_.lift(corner), 1).front().index];
      const double a_millimetre = turn.dot(motion_on_plane(cloud_.normals[point]));
      for (std::size_t e = 0; e < growth.size(); ++e) {
        growth[e] += cloud_.shared_errors_mm[e][point] * a_millimetre;
      }
    }
    return growth;
  }

 private:
  /// How the section moves where the skin moves by 1 along its normal.
  Vector2d motion_on_plane(const Vector3d& normal) const {
    const Vector2d in_plane(plane_.u().dot(normal), plane_.v().dot(normal));
    return in_plane / std::max(kLeastCrosswise * kLeastCrosswise, in_plane.squaredNorm());
  }

  const TapePlane& plane_;
  const PointCloud& cloud_;
  std::vector<std::size_t> points_;  ///< in the cloud
  PointIndex index_;                 ///< of these
};

double u95_of(const std::vector<double>& growth) {
  double variance = 0.0;
  for (const double more : growth) variance += more * more;
  return kDeviations * std::sqrt(variance);
}

}  // namespace

SharedLengthDoubt shared_doubt_of(const std::vector<Vector2d>& line, const TapePlane& plane,
                                  const PointCloud& cloud) {
  if (cloud.shared_errors_mm.empty()) return {};
  const ErringSkin skin(plane, cloud, kBesideShare * perimeter(line));
  if (skin.empty()) return {};
  return {u95_of(skin.growth_of(line)), u95_of(skin.growth_of(convex_hull(line)))};
}

}  // namespace instep
