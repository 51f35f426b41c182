#include "core/foot/shared_doubt.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/polygon.h"
#include "core/girth/length_doubt.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Skin that hardly meets the plane crosswise moves along it by so many times its error at most.
constexpr double kLeastCrosswise = 0.3;

}  // namespace

SharedDoubt::SharedDoubt(const FootScan& foot, const SeenSkin& seen) : foot_(foot), seen_(seen) {
  const auto& errors = foot.cloud.shared_errors_mm;
  moved_.assign(errors.size(), foot.landmarks);
  for (const auto& [name, landmark] : foot.landmarks) {
    const auto skin = seen.nearest(landmark.position_mm);
    if (!skin) return;
    for (std::size_t e = 0; e < errors.size(); ++e) {
      moved_[e][name].position_mm += errors[e][skin->index] * foot.cloud.normals[skin->index];
    }
  }
}

double SharedDoubt::of_landmarks(
    const std::function<Result<double>(const Landmarks&)>& measure) const {
  const auto still = measure(foot_.landmarks);
  if (!still) return 0.0;
  double variance = 0.0;
  for (const auto& moved : moved_) {
    const auto value = measure(moved);
    if (value) variance += std::pow(*value - *still, 2);
  }
  return kDeviations * std::sqrt(variance);
}

double SharedDoubt::of_girth(const Girth& girth, const TapePlane& plane) const {
  const auto& errors = foot_.cloud.shared_errors_mm;
  if (errors.empty()) return 0.0;
  const auto tape = convex_hull(girth.contour);
  const std::size_t count = tape.size();
  if (count < 3) return 0.0;
  std::vector<double> lengthened(errors.size(), 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d& corner = tape[i];
    const Vector2d turn = (corner - tape[(i + count - 1) % count]).normalized() -
                          (tape[(i + 1) % count] - corner).normalized();
    const auto skin = seen_.nearest(plane.lift(corner));
    if (!skin) return 0.0;
    const Vector3d& normal = foot_.cloud.normals[skin->index];
    const Vector2d in_plane(plane.u().dot(normal), plane.v().dot(normal));
    const double squared = std::max(kLeastCrosswise * kLeastCrosswise, in_plane.squaredNorm());
    const double a_millimetre = turn.dot(in_plane) / squared;
    for (std::size_t e = 0; e < lengthened.size(); ++e) {
      lengthened[e] += errors[e][skin->index] * a_millimetre;
    }
  }
  double variance = 0.0;
  for (const double length : lengthened) variance += length * length;
  return kDeviations * std::sqrt(variance);
}

}  // namespace instep
