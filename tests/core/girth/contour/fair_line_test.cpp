#include "core/girth/contour/fair_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

/// A circle of radius one whose radius swings by `depth`, `waves` times a turn.
Contour circle(int corners, double depth = 0.0, int waves = 0) {
  Contour contour;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    contour.points.emplace_back((1.0 + depth * std::sin(waves * angle)) * out);
    contour.outward.push_back(out);
  }
  return contour;
}

TEST(FairLine, LiesOnACircle) {
  const auto line = FairLine::through(circle(200), 0.25);
  ASSERT_TRUE(line);
  for (double way = 0.0; way < line->length(); way += 0.17) {
    const auto place = line->at(way);
    EXPECT_NEAR(place.point.norm(), 1.0, 1e-5);
    EXPECT_NEAR(place.outward.dot(place.point), 1.0, 1e-4);
    EXPECT_NEAR(place.tangent.norm(), 1.0, 1e-3);
    EXPECT_NEAR(place.tangent.dot(place.outward), 0.0, 1e-12);
  }
}

TEST(FairLine, FindsHeightsOverTheCurveNotOverItsChords) {
  // Chords of this circle lie up to 0.005 inside of it.
  const auto line = FairLine::through(circle(31), 0.3);
  ASSERT_TRUE(line);
  for (double angle = 0.02; angle < 6.2; angle += 0.19) {
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    for (const double height : {-0.1, 0.0, 0.05}) {
      const auto foot = line->foot_of((1.0 + height) * out);
      EXPECT_NEAR(foot.height, height, 2e-4);
      EXPECT_NEAR(foot.distance, std::abs(height), 3e-4);
      EXPECT_NEAR(std::remainder(foot.way - angle * line->length() / (2.0 * std::numbers::pi),
                                 line->length()),
                  0.0, 2e-3);
    }
  }
}

/// Looks at places all along the line.
TEST(FairLine, FindsTheNearestPlaceOfAll) {
  const auto line = FairLine::through(circle(400, 0.12, 3), 0.25);
  ASSERT_TRUE(line);
  test::RandomNumbers random(1);
  for (int i = 0; i < 200; ++i) {
    const auto from = line->at(random.uniform(0.0, line->length()));
    const Eigen::Vector2d point = from.point + random.uniform(-0.2, 0.4) * from.outward;
    double nearest = std::numeric_limits<double>::infinity();
    for (double way = 0.0; way < line->length(); way += 2.5e-4) {
      nearest = std::min(nearest, (line->at(way).point - point).norm());
    }
    const auto foot = line->foot_of(point);
    EXPECT_NEAR(foot.distance, nearest, 2e-4) << point.transpose();
    EXPECT_NEAR((line->at(foot.way).point - point).norm(), foot.distance, 1e-12);
    EXPECT_NEAR(std::abs(foot.height), foot.distance, 2e-4);
  }
}

TEST(FairLine, FollowsTheShapeButNotItsWaves) {
  const auto lobed = FairLine::through(circle(400, 0.05, 3), 0.25);
  const auto waved = FairLine::through(circle(400, 0.05, 60), 0.25);
  ASSERT_TRUE(lobed && waved);
  EXPECT_NEAR(lobed->foot_of({0.0, 1.0}).height, 0.05, 0.002);  // the lobes' hollow there
  double most = 0.0;
  for (double way = 0.0; way < waved->length(); way += 0.05) {
    most = std::max(most, std::abs(waved->at(way).point.norm() - 1.0));
  }
  EXPECT_LT(most, 0.01);
}

TEST(FairLine, NeedsRoomForItsKnots) {
  EXPECT_FALSE(FairLine::through(circle(200), 2.0));
}

}  // namespace
}  // namespace instep
