#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/foot/measure_set.h"
#include "daemon/scan/scan_pipeline.h"
#include "sim/simulated_station.h"

namespace instep::test {

/// What one press of the pedal brings at a simulated station, and what is true of it.
struct SimulatedScan {
  Capture capture;
  std::vector<SubjectTruth> truth;  ///< of each foot
};

/// At the pace of the processor. Fails as building the station and its cameras do.
Result<SimulatedScan> scan_of(SimulationSettings settings);

/// Measures that have an interval and a truth.
int number_known(const MeasureSet& measures, const std::map<std::string, double>& truth);

/// Of these, those whose interval holds the truth.
int number_held(const MeasureSet& measures, const std::map<std::string, double>& truth);

/// Every measure that has a truth meets it, to a millimetre where its interval is narrower.
void expect_true_measures(const MeasureSet& measures, const std::map<std::string, double>& truth);

/// Whether one of the warnings has these words.
bool is_said(const std::string& words, const std::vector<std::string>& warnings);

}  // namespace instep::test
