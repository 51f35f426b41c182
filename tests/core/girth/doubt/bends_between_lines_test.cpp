#include "core/girth/doubt/bends_between_lines.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/prism_points.h"
#include "tests/support/random_numbers.h"
#include "tests/support/traced_section.h"

namespace instep {
namespace {

using test::many_sided;
using test::place_round;
using test::PrismCorners;

const PrismCorners& box() {
  static const PrismCorners corners = {{-30, -20}, {30, -20}, {30, 20}, {-30, 20}};
  return corners;
}

/// Along a body with that section stand columns of points, `step` apart on each, none beside
/// another.
PointCloud in_columns(const PrismCorners& corners, int columns, double step, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  PointCloud cloud;
  const double begin = random.uniform();
  for (int column = 0; column < columns; ++column) {
    const auto place = place_round(corners, (column + begin) * perimeter(corners) / columns);
    for (double height = random.uniform(0.0, step) - 25.0; height < 25.0; height += step) {
      cloud.positions.emplace_back(place.x(), place.y(), height);
    }
  }
  return cloud;
}

/// Level rings, none of whose points stands over another.
PointCloud in_rings(const PrismCorners& corners, int rings, double step, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  PointCloud cloud;
  for (int ring = 0; ring < rings; ++ring) {
    const double height = 50.0 * (ring + 0.5) / rings - 25.0;
    for (double way = random.uniform(0.0, step); way < perimeter(corners); way += step) {
      const auto place = place_round(corners, way);
      cloud.positions.emplace_back(place.x(), place.y(), height);
    }
  }
  return cloud;
}

UnseenBends bends_of(const PointCloud& cloud) {
  const test::TracedSection section(cloud);
  return bends_between_lines(ContourCourse(section.contour), section.surface, section.spacing);
}

TEST(BendsBetweenLines, AreThoseOfABoxInColumns) {
  const auto bends = bends_of(in_columns(box(), 60, 0.8, 1));
  EXPECT_GT(bends.contact_u95, 0.01);
  EXPECT_GT(bends.stretched_u95, 0.01);
  EXPECT_LE(bends.stretched_u95, bends.contact_u95);
}

TEST(BendsBetweenLines, AreTheSameWhereverTheContourBegins) {
  test::TracedSection section(in_columns(box(), 60, 0.8, 1));
  const auto bends =
      bends_between_lines(ContourCourse(section.contour), section.surface, section.spacing);
  for (int i = 0; i < 40; ++i) {
    section.begin_later(7);
    const auto same =
        bends_between_lines(ContourCourse(section.contour), section.surface, section.spacing);
    EXPECT_NEAR(same.contact_u95, bends.contact_u95, 1e-12) << i;
  }
}

TEST(BendsBetweenLines, AreNoneOfRoundBodies) {
  EXPECT_EQ(bends_of(in_columns(many_sided(720, 35, 25), 60, 0.8, 1)).contact_u95, 0.0);
}

TEST(BendsBetweenLines, AreNoneOfPointsAtRandomOrInLinesAlongTheContour) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    EXPECT_EQ(bends_of(test::prism_points(box(), 4000, seed)).contact_u95, 0.0) << seed;
    EXPECT_EQ(bends_of(in_rings(box(), 15, 0.8, seed)).contact_u95, 0.0) << seed;
  }
}

struct Told {
  int held = 0;
  double mean_half_width = 0.0;
};

/// Twelve draws of 60 columns, four times as far apart as their points.
Told told_in_columns(const PrismCorners& corners) {
  const double step = perimeter(corners) / 60 / 4;
  Told told;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto girth = girth_by_rbf(in_columns(corners, 60, step, seed), test::level_plane());
    if (!girth) continue;
    const double error = std::abs(girth->stretched_mm - perimeter(corners));
    told.held += error <= *girth->stretched_u95_mm;
    told.mean_half_width += *girth->stretched_u95_mm / 12;
  }
  return told;
}

// Measured, of 12 each: 8, 12 and 9 hold (one refused), and without these bends 0, 0 and 2: boxes
// are 2.1 mm too short, by an interval of 4.0 in place of 0.03.
TEST(BendsBetweenLines, LetIntervalsOfPrismsHold) {
  const Told of_box = told_in_columns(box());
  EXPECT_GE(of_box.held, 6);
  EXPECT_LT(of_box.mean_half_width, 5.0);
  EXPECT_GE(told_in_columns(many_sided(7, 30, 25)).held, 10);
  EXPECT_GE(told_in_columns(many_sided(3, 30, 25)).held, 6);
}

TEST(BendsBetweenLines, LeaveTheIntervalsOfRoundBodiesNarrow) {
  const auto corners = many_sided(720, 35, 25);
  const auto girth = girth_by_rbf(in_columns(corners, 60, 0.8, 1), test::level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->stretched_mm, perimeter(corners), 0.005);
  EXPECT_LT(*girth->stretched_u95_mm, 0.01);
}

// Measured: 0.4 and 0.7 mm short, by an interval of 10: of 36 columns none knows a lobe from edges.
TEST(BendsBetweenLines, RefuseNoLobedBody) {
  PrismCorners lobed = many_sided(720, 35, 35);
  for (auto& corner : lobed)
    corner *= 1.0 + 0.1 * std::cos(8.0 * std::atan2(corner.y(), corner.x()));
  const auto girth =
      girth_by_rbf(in_columns(lobed, 36, perimeter(lobed) / 36 / 4, 1), test::level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, perimeter(lobed), *girth->contact_u95_mm);
  EXPECT_LT(*girth->contact_u95_mm, 0.045 * perimeter(lobed));
}

TEST(BendsBetweenLines, AreNamedByTheGirth) {
  const auto girth = girth_by_rbf(in_columns(box(), 30, 1.7, 1), test::level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  const std::string said = fmt::format("{}", fmt::join(girth->warnings, "; "));
  EXPECT_NE(said.find("edges between the lines"), std::string::npos) << said;
}

}  // namespace
}  // namespace instep
