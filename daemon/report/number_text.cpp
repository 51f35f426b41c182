#include "daemon/report/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "daemon/report/json_number.h"

namespace instep {

std::string tenths(double value) {
  return fmt::format("{:.1f}", rounded_to(value, 0.001));
}

std::string interval_tenths(double u95) {
  return tenths(u95 < 0.1 ? 0.1 : u95);
}

std::string interval_text(double value, const std::optional<double>& u95) {
  return u95 ? fmt::format("{} ± {}", tenths(value), interval_tenths(*u95)) : tenths(value);
}

std::string measure_text(const Measure& measure) {
  return interval_text(measure.value(), measure.u95()) + (measure.value_deg ? "°" : " mm");
}

std::string at_least_percent(double share) {
  return fmt::format("{:.0f} %", std::floor(100.0 * share + 1e-9));
}

std::string as_words(std::string id) {
  std::replace(id.begin(), id.end(), '_', ' ');
  return id;
}

}  // namespace instep
