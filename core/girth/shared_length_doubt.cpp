#include "core/girth/shared_length_doubt.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/geometry/polygon.h"
#include "core/geometry/seen_skin.h"
#include "core/girth/length_doubt.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Skin that hardly meets the plane crosswise moves along it by its error over so much at most.
constexpr double kLeastCrosswise = 0.3;

/// What was seen of a cloud's skin, with what is known of its errors.
class ErringSkin {
 public:
  ErringSkin(const TapePlane& plane, const PointCloud& cloud)
      : plane_(plane), cloud_(cloud), seen_(cloud) {}

  /// How much longer a closed line grows by each of the errors, one sigma.
  std::vector<double> growth_of(const std::vector<Vector2d>& line) const {
    std::vector<double> growth(cloud_.shared_errors_mm.size(), 0.0);
    const std::size_t count = line.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d& corner = line[i];
      const Vector2d turn = (corner - line[(i + count - 1) % count]).normalized() -
                            (line[(i + 1) % count] - corner).normalized();
      const auto skin = seen_.nearest(plane_.lift(corner));
      if (!skin) continue;
      const double a_millimetre = turn.dot(motion_on_plane(cloud_.normals[skin->index]));
      for (std::size_t e = 0; e < growth.size(); ++e) {
        growth[e] += cloud_.shared_errors_mm[e][skin->index] * a_millimetre;
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
  SeenSkin seen_;
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
  const ErringSkin skin(plane, cloud);
  return {u95_of(skin.growth_of(line)), u95_of(skin.growth_of(convex_hull(line)))};
}

}  // namespace instep
