#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "tests/bench/shared/girth_methods.h"

namespace instep::bench {

/// What a girth cost.
struct TimedGirth {
  std::size_t points = 0;
  std::size_t band_points = 0;
  double milliseconds = 0.0;  ///< processor time, the middle one of several runs
  double peak_clouds = 0.0;   ///< most memory, the cloud's included, in units of the cloud's
  std::optional<double> stretched_mm;  ///< nothing where the method refuses
};

/// Runs a method three times, up to seven while that takes less than two seconds.
TimedGirth timed(const GirthMethod& method, const PointCloud& cloud, const TapePlane& plane);

/// Processor time of anything, likewise.
double median_milliseconds(const std::function<void()>& work);

/// Exponent of time over points by a straight line through their logarithms.
double growth_exponent(const std::vector<TimedGirth>& girths);

}  // namespace instep::bench
