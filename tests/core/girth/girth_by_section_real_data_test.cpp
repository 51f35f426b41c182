#include <gtest/gtest.h>

#include "core/girth/girth.h"
#include "tests/support/places.h"
#include "tests/support/shape_files.h"

namespace instep {
namespace {

/// Metres in the files of the retail scanner, millimetres elsewhere.
double unit_mm(const std::string& file) {
  return file.ends_with(".stl") ? 1000.0 : 1.0;
}

void expect_known_sections(const std::string& folder, double tolerance_mm) {
  if (!std::filesystem::exists(test::trial_data())) GTEST_SKIP() << "no trial data here";
  for (const auto& section : test::known_sections(folder)) {
    SCOPED_TRACE(section.file + " " + section.name);
    const auto shape =
        test::read_shape(test::trial_data() / folder / section.file, unit_mm(section.file));
    const auto girth = girth_by_section(shape.mesh, section.plane);
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_NEAR(girth->stretched_mm, section.stretched_mm, tolerance_mm);
    EXPECT_NEAR(girth->contact_mm, section.contact_mm, tolerance_mm);
  }
}

TEST(GirthBySectionOfRealBodies, AgreesWithTheSectionsOfScannedFeet) {
  expect_known_sections("feet", 0.01);
}

// The truth is that of a far denser tessellation of the same surface: chords cut off up to half a
// millimetre here.
TEST(GirthBySectionOfRealBodies, ClosesTheUnstitchedSeamsOfLasts) {
  expect_known_sections("lasts", 0.5);
}

}  // namespace
}  // namespace instep
