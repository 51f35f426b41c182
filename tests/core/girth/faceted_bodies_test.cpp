#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/prism_points.h"

// The meshes of scanners are flat from corner to corner. Exact points on them bend at their own
// scale, which looks like a little noise, and chords cut every corner that lies between points.

namespace instep {
namespace {

struct Outcomes {
  int count = 0;
  int held = 0;
  double mean_error = 0.0;

  void add(const Result<Girth>& girth, double truth) {
    ASSERT_TRUE(girth) << girth.error().line();
    const double error = std::abs(girth->stretched_mm - truth);
    mean_error = (mean_error * count + error) / (count + 1);
    held += error <= girth->stretched_u95_mm.value_or(0.0);
    ++count;
  }
};

Outcomes on_prisms(int sides, int points, int draws) {
  const auto corners = test::many_sided(sides, 40.0, 28.0);
  Outcomes outcomes;
  for (int i = 0; i < draws; ++i) {
    const auto cloud = test::prism_points(corners, points, static_cast<std::uint64_t>(1 + i));
    outcomes.add(girth_by_rbf(cloud, test::level_plane()), perimeter(corners));
  }
  return outcomes;
}

// Measured: 0.012 to 0.10 mm short; 19 of 24 intervals hold, for all corners of a prism lie across
// the tape. Without the expected waves of such points none did.
TEST(FacetedBodies, OfManySidesAreNotMuchTooShort) {
  Outcomes fine;
  for (const int sides : {60, 90}) {
    for (const int points : {2000, 6000, 20000}) {
      const auto outcomes = on_prisms(sides, points, 4);
      EXPECT_LT(outcomes.mean_error, 0.13) << sides << " sides, " << points << " points";
      fine.count += outcomes.count;
      fine.held += outcomes.held;
    }
  }
  EXPECT_GE(fine.held, fine.count / 2);
}

// Edges of 15 to 26 degrees are rounded, and the tape is 0.2 to 0.6 mm short. Measured: 90 of 96
// intervals hold; 64 where bends between points did not count.
TEST(FacetedBodies, OfSomeSidesAreToldWithinTheirIntervals) {
  Outcomes all;
  for (const int sides : {14, 18, 24}) {
    for (const int points : {600, 1500}) {
      const auto outcomes = on_prisms(sides, points, 16);
      all.count += outcomes.count;
      all.held += outcomes.held;
    }
  }
  EXPECT_GE(all.held, 9 * all.count / 10);
}

TEST(FacetedBodies, ShowTheirCornersToCrowdsOfPoints) {
  EXPECT_LT(on_prisms(24, 100000, 1).mean_error, 0.06) << "averages over crowds blur them";
}

}  // namespace
}  // namespace instep
