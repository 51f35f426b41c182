#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/foot/measure_set.h"
#include "core/foot/side.h"

namespace instep {

/// One measure of both feet of a person.
struct MeasurePair {
  std::string id;
  double left_mm = 0.0;
  double right_mm = 0.0;
  /// Half-width of the 95 % interval of the difference, if both values have one: the root of the
  /// sum of their squares. What one station gets wrong in both feet alike makes it too wide, never
  /// too narrow.
  std::optional<double> u95_mm;

  double difference_mm() const { return right_mm - left_mm; }

  /// The larger foot; nothing where the difference is none or lies within its interval.
  std::optional<Side> larger() const;
};

/// The two feet of a person side by side.
struct FootPair {
  std::vector<MeasurePair> measures;     ///< that both feet have, in the order of the left one's
  std::vector<std::string> of_one_foot;  ///< ids that only one foot has

  const MeasurePair* find(const std::string& id) const;

  /// The foot that a pair of shoes goes by: the longer one. Nothing where that cannot be told.
  std::optional<Side> leading() const;
};

/// Values that are no finite numbers count as missing.
FootPair pair_feet(const MeasureSet& left, const MeasureSet& right);

}  // namespace instep
