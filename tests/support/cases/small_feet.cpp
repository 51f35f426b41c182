#include "tests/support/cases/small_feet.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"

namespace instep::test {

PointCloud scaled(PointCloud cloud, double share) {
  for (auto& point : cloud.positions) point *= share;
  return cloud;
}

Result<MeasureSet> all_measures_of(const PointCloud& cloud) {
  return align_foot(cloud).and_then(find_landmarks).and_then([](const FootScan& foot) {
    return measure_foot(foot);
  });
}

Proportion proportion_of(const MeasureSet& grown, const MeasureSet& child, double share) {
  Proportion proportion;
  for (const auto& measure : grown.measures) {
    const Measure* own = child.find(measure.id);
    if (own == nullptr) continue;
    const double scale = measure.value_deg ? 1.0 : share;
    const double u95 = std::hypot(own->u95().value(), scale * measure.u95().value());
    const double off = std::abs(own->value() - scale * measure.value()) / u95;
    ++proportion.measures;
    if (off <= 1.0) ++proportion.held;
    proportion.worst = std::max(proportion.worst, off);
  }
  return proportion;
}

}  // namespace instep::test
