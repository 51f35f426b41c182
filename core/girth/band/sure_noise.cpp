#include "core/girth/band/sure_noise.h"

#include <cmath>

#include "core/girth/band/rounded_places.h"
#include "core/surface/noise/close_pairs.h"

namespace instep {
namespace {

/// Noise, against the spacing, that no shape is taken for.
constexpr double kPlain = 0.03;
/// What rounding makes, against the noise that it has to explain: where it is not rounding but a
/// lattice that exact points lie on, it would be far more.
constexpr double kExplained = 0.5;
constexpr double kFarMore = 4.0;

}  // namespace

bool is_surely_noise(const PlaneBand& band, const PointCloud& cloud, bool is_told) {
  if (is_told && band.told_scale == 1.0 && band.uneven.empty()) return true;
  const bool matters = !is_harmless(band.sigma * band.sigma, band.spacing, true);
  if (!matters || band.sigma >= kPlain * band.spacing) return false;
  const double explained = rounding_step_mm(band, cloud) / std::sqrt(12.0) / band.noise_mm();
  return (explained > kExplained && explained < kFarMore) ||
         is_noise_between_pairs(band.points, band.index, band.spacing, band.sigma);
}

}  // namespace instep
