#include "tests/support/simulated_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/support/simulated_capture.h"

namespace instep::test {

Result<SimulatedScan> scan_of(SimulationSettings settings) {
  settings.pacing = Pacing::kAsFastAsPossible;
  auto station = build_station(settings);
  if (!station) return tl::make_unexpected(station.error());
  auto truth = station->truth();
  if (!truth) return tl::make_unexpected(truth.error());
  auto capture = capture_of(*station);
  if (!capture) return tl::make_unexpected(capture.error());
  return SimulatedScan{*std::move(capture), *std::move(truth)};
}

int number_known(const MeasureSet& measures, const std::map<std::string, double>& truth) {
  return static_cast<int>(std::count_if(
      measures.measures.begin(), measures.measures.end(),
      [&truth](const Measure& measure) { return measure.u95() && truth.contains(measure.id); }));
}

int number_held(const MeasureSet& measures, const std::map<std::string, double>& truth) {
  return static_cast<int>(std::count_if(
      measures.measures.begin(), measures.measures.end(), [&truth](const Measure& measure) {
        const auto known = truth.find(measure.id);
        return measure.u95() && known != truth.end() &&
               std::abs(measure.value() - known->second) <= *measure.u95();
      }));
}

void expect_true_measures(const MeasureSet& measures, const std::map<std::string, double>& truth) {
  for (const auto& [id, value] : truth) {
    const Measure* measure = measures.find(id);
    if (id == "arch_height") {
      EXPECT_EQ(measure, nullptr) << "no camera sees the arch";
      continue;
    }
    ASSERT_NE(measure, nullptr) << id;
    // A tape round the heel runs over its lower edge, which no camera sees.
    const double guessed_mm = id == "short_heel_girth" || id == "long_heel_girth" ? 1.5 : 1.0;
    // Where the scan leaves a landmark in doubt by more, the measure says so.
    EXPECT_NEAR(measure->value(), value, std::max(guessed_mm, measure->u95().value_or(0.0))) << id;
  }
}

bool is_said(const std::string& words, const std::vector<std::string>& warnings) {
  return std::any_of(warnings.begin(), warnings.end(), [&words](const auto& warning) {
    return warning.find(words) != std::string::npos;
  });
}

}  // namespace instep::test
