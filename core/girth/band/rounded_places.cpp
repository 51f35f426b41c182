#include "core/girth/band/rounded_places.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "core/geometry/coordinate_step.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

constexpr double kLeastStepMm = 0.2;
constexpr double kDitheredInSteps = 0.5;
constexpr double kExactInSteps = 0.07;  ///< a quarter of what rounding makes
/// Four, of which the skin beside them takes out about half: of rounded cylinders.
constexpr double kLevelStretches = 2.0;

}  // namespace

double rounding_step_mm(const PlaneBand& band, const PointCloud& cloud) {
  std::vector<Eigen::Vector3d> places;
  places.reserve(band.sources.size());
  for (const std::size_t source : band.sources) places.push_back(cloud.positions[source]);
  return coordinate_step(places);
}

double doubt_of_rounding(const PlaneBand& band, const PointCloud& cloud, double length) {
  if (band.sigma * band.unit_mm < kExactInSteps * kLeastStepMm) return 0.0;
  if (!is_coordinate_step_over(kLeastStepMm, cloud.positions)) return 0.0;
  const double step = rounding_step_mm(band, cloud) / band.unit_mm;
  if (band.sigma > kDitheredInSteps * step || band.sigma < kExactInSteps * step) return 0.0;
  const double radius = length / (2.0 * std::numbers::pi);
  // As far round as an arc of that radius stays within half a step of its level.
  const double turn = 2.0 * std::sqrt(step / radius);
  return kDeviations * std::sqrt(kLevelStretches / 12.0) * step * turn;
}

}  // namespace instep
