#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "core/foot/alignment.h"
#include "core/geometry/distinct_points.h"
#include "tests/support/random_numbers.h"
#include "tests/support/real_feet.h"

namespace instep {
namespace {

using test::measured;
using test::MeasuredFoot;
using test::RandomNumbers;

/// Real feet, with points that are not theirs.
class DirtyFeet : public test::RealFeet {};

bool warns_of_strays(const FootScan& foot) {
  return std::any_of(foot.warnings.begin(), foot.warnings.end(), [](const std::string& warning) {
    return warning.find("strays off the skin") != std::string::npos;
  });
}

void expect_same(const MeasuredFoot& dirty, const MeasuredFoot& clean) {
  EXPECT_TRUE(warns_of_strays(dirty.foot));
  EXPECT_EQ(dirty.foot.side, clean.foot.side);
  for (const auto& truth : clean.set.measures) {
    const Measure* measure = dirty.set.find(truth.id);
    ASSERT_NE(measure, nullptr) << truth.id;
    EXPECT_NEAR(measure->value(), truth.value(),
                std::hypot(measure->u95().value(), truth.u95().value()))
        << truth.id;
  }
}

/// As light that is scattered in the glass under a foot: it was taken for the sole, and all heights
/// were 10 mm too large, without a word.
TEST_F(DirtyFeet, WithHazeBelowThemAreMeasuredWithoutIt) {
  for (const char* name : {"retail_left.stl", "retail_right.stl"}) {
    auto points = cloud(name, 1000.0);
    points = points.subset(distinct_points(points));
    const auto clean = measured(points);
    Eigen::AlignedBox3d box;
    for (const auto& point : points.positions) box.extend(point);
    for (const auto& [share, deep_mm] : {std::pair(0.03, 12.0), {0.05, 12.0}, {0.1, 30.0}}) {
      SCOPED_TRACE(testing::Message() << name << " " << share << " " << deep_mm);
      RandomNumbers random(17);
      PointCloud dirty;
      dirty.positions = points.positions;
      for (std::size_t i = 0;
           i < static_cast<std::size_t>(share * static_cast<double>(points.size())); ++i) {
        dirty.positions.emplace_back(random.uniform(box.min().x(), box.max().x()),
                                     random.uniform(box.min().y(), box.max().y()),
                                     box.min().z() - random.uniform(3.0, deep_mm));
      }
      expect_same(measured(dirty), clean);
    }
  }
}

}  // namespace
}  // namespace instep
