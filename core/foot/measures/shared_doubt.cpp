#include "core/foot/measures/shared_doubt.h"

#include <cmath>

#include "core/normal_spread.h"

namespace instep {

SharedDoubt::SharedDoubt(const FootScan& foot, const SeenSkin& seen) : foot_(foot) {
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

double SharedDoubt::of(const std::function<Result<double>(const Landmarks&)>& measure) const {
  const auto still = measure(foot_.landmarks);
  if (!still) return 0.0;
  double variance = 0.0;
  for (const auto& moved : moved_) {
    const auto value = measure(moved);
    if (value) variance += std::pow(*value - *still, 2);
  }
  return kDeviations * std::sqrt(variance);
}

}  // namespace instep
