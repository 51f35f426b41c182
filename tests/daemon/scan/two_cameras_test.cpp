#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "daemon/scan/scan_pipeline.h"
#include "tests/support/simulated_scan.h"

namespace instep {
namespace {

/// A camera before a foot and one behind it: nobody sees a stretch of its sides.
SimulationSettings two_cameras(std::uint64_t seed) {
  SimulationSettings settings;
  settings.seed = seed;
  settings.side = seed % 2 == 0 ? Side::kLeft : Side::kRight;
  settings.cameras = 2;
  settings.width_px = 320;
  settings.height_px = 240;
  return settings;
}

/// It comes in two parts, and is one foot all the same.
TEST(TwoCameras, MeasureAFootWhole) {
  const auto scan = test::scan_of(two_cameras(2));
  ASSERT_TRUE(scan) << scan.error().line();
  const auto records = measure_capture(scan->capture, {}, {});
  ASSERT_TRUE(records) << records.error().line();
  const Measure* length = records->front().measures.find("foot_length");
  ASSERT_NE(length, nullptr);
  EXPECT_NEAR(length->value_mm, scan->truth.front().measures.at("foot_length"), 1.0);
  const auto& warnings = records->front().foot.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("comes in 2 parts") != std::string::npos;
  }));
}

/// Its shape tells the wrong side. The height of the first toe was that of the little one, 4 to 5
/// mm lower, told to within a millimetre.
TEST(TwoCameras, KnowThatTheyMayTakeAFootForTheOtherOne) {
  for (const std::uint64_t seed : {5U, 9U, 13U, 24U}) {
    SCOPED_TRACE(seed);
    const auto settings = two_cameras(seed);
    const auto scan = test::scan_of(settings);
    ASSERT_TRUE(scan) << scan.error().line();
    const auto records = measure_capture(scan->capture, {}, {});
    ASSERT_TRUE(records) << records.error().line();
    const FootScan& foot = records->front().foot;
    const MeasureSet& measures = records->front().measures;
    EXPECT_NE(foot.side, settings.side);
    EXPECT_FALSE(foot.is_side_sure());
    const auto& truth = scan->truth.front().measures;
    EXPECT_GE(test::number_known(measures, truth), 4);
    EXPECT_EQ(test::number_held(measures, truth), test::number_known(measures, truth));
  }
}

/// The borders were not seen where they are furthest: the breadth of what was seen is 5 to 9 mm
/// less than the foot's, and was told to within 4 to 6 mm.
TEST(TwoCameras, KnowThatTheSidesMayBulgeWhereNobodySeesThem) {
  int told = 0;
  for (const std::uint64_t seed : {14U, 19U, 30U, 38U}) {
    SCOPED_TRACE(seed);
    const auto scan = test::scan_of(two_cameras(seed));
    ASSERT_TRUE(scan) << scan.error().line();
    const auto records = measure_capture(scan->capture, {}, {});
    ASSERT_TRUE(records) << records.error().line();
    const Measure* breadth = records->front().measures.find("foot_breadth_horizontal");
    if (breadth == nullptr) continue;  // told to no use
    const double truth = scan->truth.front().measures.at("foot_breadth_horizontal");
    EXPECT_NEAR(breadth->value_mm, truth, breadth->u95_mm.value());
    ++told;
  }
  EXPECT_GE(told, 1);
}

}  // namespace
}  // namespace instep
