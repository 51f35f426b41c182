#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "tests/support/cases/small_feet.h"
#include "tests/support/places.h"
#include "tests/support/shape_files.h"

namespace instep {
namespace {

/// A foot of 120 mm had the outside of its ball 5 to 8 mm too far back and its ball girth 3 mm too
/// long, by intervals of a third of a millimetre: windows in millimetres took in what lies beside.
TEST(SmallRealFeet, AreMeasuredInProportion) {
  const auto folder = test::trial_data() / "feet";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no trial data";
  for (const auto& [name, unit_mm] : {std::pair("retail_left.stl", 1000.0),
                                      {"retail_right.stl", 1000.0},
                                      {"lab_left.ply", 1.0}}) {
    const auto cloud = test::read_shape(folder / name, unit_mm).cloud;
    const auto grown = test::all_measures_of(cloud);
    ASSERT_TRUE(grown) << name << ": " << grown.error().line();
    const double length = grown->find("foot_length")->value_mm;
    for (const double child_mm : {122.0, 150.0, 180.0, 220.0}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(child_mm));
      const double share = child_mm / length;
      const auto child = test::all_measures_of(test::scaled(cloud, share));
      ASSERT_TRUE(child) << child.error().line();
      const auto proportion = test::proportion_of(*grown, *child, share);
      EXPECT_GE(proportion.measures, 15);
      EXPECT_EQ(proportion.held, proportion.measures);
    }
  }
}

}  // namespace
}  // namespace instep
