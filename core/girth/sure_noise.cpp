#include "core/girth/sure_noise.h"

#include <cmath>
#include <vector>

#include "core/geometry/coordinate_step.h"
#include "core/surface/close_pairs.h"

namespace instep {
namespace {

/// Noise, against the spacing, that matters nowhere, and that no shape is taken for.
constexpr double kHarmless = 5e-4;
constexpr double kPlain = 0.03;
/// Of the noise, what rounding has to explain.
constexpr double kExplained = 0.5;

/// In millimetres.
double noise_of_rounding(const PlaneBand& band, const PointCloud& cloud) {
  std::vector<Eigen::Vector3d> places;
  places.reserve(band.sources.size());
  for (const std::size_t source : band.sources) places.push_back(cloud.positions[source]);
  return coordinate_step(places) / std::sqrt(12.0);
}

}  // namespace

bool shows_sure_noise(const PlaneBand& band, const PointCloud& cloud) {
  const double relative = band.sigma / band.spacing;
  if (!(relative > kHarmless && relative < kPlain)) return false;
  return noise_of_rounding(band, cloud) > kExplained * band.unit_mm * band.sigma ||
         is_noise_between_pairs(band.points, band.index, band.spacing, band.sigma);
}

}  // namespace instep
