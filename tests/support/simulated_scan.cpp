#include "tests/support/simulated_scan.h"

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

}  // namespace instep::test
