#include "daemon/report/json_number.h"

#include <cmath>

namespace instep {

double rounded_to(double value, double step) {
  const double per_unit = std::round(1.0 / step);
  const double rounded = std::round(value * per_unit) / per_unit;
  return rounded == 0.0 ? 0.0 : rounded;
}

Json json_number(double value, double step) {
  if (!std::isfinite(value)) return nullptr;
  return rounded_to(value, step);
}

Json json_number(const std::optional<double>& value, double step) {
  return value ? json_number(*value, step) : Json(nullptr);
}

}  // namespace instep
