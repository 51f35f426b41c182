#pragma once

#include "core/foot/measure_set.h"
#include "core/geometry/point_cloud.h"
#include "core/result.h"

namespace instep::test {

/// A cloud seen so many times as large.
PointCloud scaled(PointCloud cloud, double share);

/// A cloud of one foot aligned, marked and measured.
Result<MeasureSet> all_measures_of(const PointCloud& cloud);

/// How a child's foot was measured against the grown one that it is a scaled copy of.
struct Proportion {
  int measures = 0;    ///< of both
  int held = 0;        ///< in proportion, within their intervals
  double worst = 0.0;  ///< how many of its intervals one is off
};

/// Angles stay, lengths have the share of those of the grown foot.
Proportion proportion_of(const MeasureSet& grown, const MeasureSet& child, double share);

}  // namespace instep::test
