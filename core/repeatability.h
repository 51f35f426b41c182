#pragma once

#include <vector>

namespace instep {

/// How far repeated measurements of one quantity lie apart, in its own unit.
struct Repeatability {
  std::vector<double> values;  ///< in the order they were taken
  double mean = 0.0;
  double standard_deviation = 0.0;  ///< of the sample (n - 1)
  double least = 0.0;
  double greatest = 0.0;
  /// Of any two of them, the mean of the absolute difference. Studies of foot scanners report it
  /// beside what ISO 20685-1 allows.
  double mean_absolute_difference = 0.0;

  /// The largest difference of two of them.
  double range() const { return greatest - least; }
};

/// Needs at least two values, all of them finite. O(n log n).
Repeatability repeatability(std::vector<double> values);

}  // namespace instep
