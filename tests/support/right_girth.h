#pragma once

#include <gtest/gtest.h>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"

namespace instep::test {

/// That both lengths round the tests' cylinder in the oblique plane are within their intervals, and
/// these narrower than that.
inline void expect_right_girth(const PointCloud& cloud, double most_u95_mm) {
  static const double truth =
      true_girth(elliptic_cylinder(kCylinderRadius, kCylinderRadius), oblique_plane());
  const auto girth = girth_by_rbf(cloud, oblique_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, truth, *girth->contact_u95_mm);
  EXPECT_NEAR(girth->stretched_mm, truth, *girth->stretched_u95_mm);
  EXPECT_LT(*girth->contact_u95_mm, most_u95_mm);
}

}  // namespace instep::test
