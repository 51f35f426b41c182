#include "core/girth/doubt/bends_in_space.h"

#include <gtest/gtest.h>

#include "tests/support/prism_points.h"
#include "tests/support/traced_section.h"

namespace instep {
namespace {

/// Round tips of a third of a millimetre, which no point shows.
PointCloud thin_ellipse() {
  return test::prism_points(test::many_sided(720, 48.0, 4.0), 900, 1);
}

UnseenBends bends_of(const test::TracedSection& section, double times = 1.0) {
  return bends_in_space(ContourCourse(section.contour), section.surface, times * section.spacing);
}

TEST(BendsInSpace, AreThoseAtTheTipsOfAThinBody) {
  const test::TracedSection section(thin_ellipse());
  const auto bends = bends_of(section);
  EXPECT_GT(bends.contact_u95, 0.3 * section.spacing);
  EXPECT_LT(bends.contact_u95, 3.0 * section.spacing);
  EXPECT_LE(bends.stretched_u95, bends.contact_u95);
  EXPECT_EQ(bends_of(section, 0.0).contact_u95, 0.0);
}

TEST(BendsInSpace, AreTheSameWhereverTheContourBegins) {
  test::TracedSection section(thin_ellipse());
  const auto bends = bends_of(section);
  for (int i = 0; i < 40; ++i) {
    section.begin_later(7);
    EXPECT_NEAR(bends_of(section).contact_u95, bends.contact_u95, 1e-12) << i;
  }
}

/// Of which smooth patches and creased ones know what they do not.
TEST(BendsInSpace, AreNoneOfThickBodies) {
  const test::PrismCorners box = {{-30, -20}, {30, -20}, {30, 20}, {-30, 20}};
  for (const auto& corners : {test::many_sided(720, 35.0, 25.0), box}) {
    const test::TracedSection section(test::prism_points(corners, 2000, 1));
    EXPECT_EQ(bends_of(section).contact_u95, 0.0);
  }
}

}  // namespace
}  // namespace instep
