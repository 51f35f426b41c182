#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"
#include "core/geometry/point_cloud.h"

namespace instep::test {

/// Of tests on the real feet of the trial data; skipped without these.
class RealFeet : public testing::Test {
 protected:
  void SetUp() override;

  /// A file's points; `unit_mm`: of its coordinates.
  static PointCloud cloud(const char* name, double unit_mm);
};

struct MeasuredFoot {
  FootScan foot;
  MeasureSet set;
};

/// Throws the reason where it cannot be measured.
MeasuredFoot measured(const PointCloud& cloud);

/// Without normals, which noise would change.
PointCloud noisy(PointCloud cloud, double sigma_mm, std::uint64_t seed);

/// Those points that are not in some part of space.
PointCloud without(const PointCloud& cloud,
                   const std::function<bool(const Eigen::Vector3d&)>& is_in);

}  // namespace instep::test
