#include "tests/support/cases/noise_floor.h"

#include <cmath>

namespace instep::test {

std::optional<double> noise_floor(const TrueLengths& lengths, std::size_t points, double sigma_mm) {
  if (!(sigma_mm > 0.0)) return std::nullopt;
  const double points_per_mm = static_cast<double>(points) / lengths.contact_mm;
  return 1.5 * sigma_mm * std::sqrt(lengths.bending / points_per_mm);
}

}  // namespace instep::test
