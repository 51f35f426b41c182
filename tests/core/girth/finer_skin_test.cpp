#include "core/girth/finer_skin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

constexpr double kLength = 2.5;
constexpr int kKnots = 42;

/// Waves round the line, under noise.
std::vector<RibbonPoint> drawn(int waves, double height, int count, double sigma,
                               std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<RibbonPoint> points;
  for (int i = 0; i < count; ++i) {
    const double way = random.uniform(0.0, kLength);
    const double wave = height * std::cos(2.0 * std::numbers::pi * waves * way / kLength);
    points.push_back({way, random.uniform(-1.0, 1.0), wave + sigma * random.normal(), 1.0});
  }
  return points;
}

bool shows_finer_skin(const std::vector<RibbonPoint>& points) {
  const auto spline = RibbonSpline::through(points, kLength, kKnots);
  if (!spline) throw std::runtime_error("no spline");
  return shows_finer_skin(points, *spline, kLength, kKnots);
}

TEST(FinerSkin, IsShownBelowTheNoise) {
  for (const int waves : {30, 40, 60}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      EXPECT_TRUE(shows_finer_skin(drawn(waves, 0.002, 15000, 0.004, seed)))
          << waves << " " << seed;
    }
  }
}

TEST(FinerSkin, IsNotShownByNoiseNorByWavesThatTheSplineFollows) {
  int shown = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    if (shows_finer_skin(drawn(0, 0.0, 5000, 0.004, seed))) ++shown;
    EXPECT_FALSE(shows_finer_skin(drawn(5, 0.02, 5000, 0.004, seed))) << seed;
  }
  EXPECT_LE(shown, 1);
}

TEST(FinerSkin, IsNotShownByTooFewPoints) {
  EXPECT_FALSE(shows_finer_skin(drawn(40, 0.01, 600, 0.004, 1)));
}

/// Twenty-two waves of 0.2 mm under noise of 0.4: the tape was told up to 1 mm too short, +-0.2.
TEST(FinerSkin, IsInTheIntervalOfAGirth) {
  const auto corner = [](double angle, double noise) {
    const double radius = 40.0 + 0.2 * std::cos(22.0 * angle) + noise;
    return Eigen::Vector2d(radius * std::cos(angle), radius * std::sin(angle));
  };
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < 40000; ++i) {
    outline.push_back(corner(2.0 * std::numbers::pi * i / 40000, 0.0));
  }
  const double contact = perimeter(outline);
  const double stretched = perimeter(convex_hull(outline));
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    test::RandomNumbers random(seed);
    PointCloud cloud;
    for (int i = 0; i < 10000; ++i) {
      const auto place = corner(random.uniform(0.0, 2.0 * std::numbers::pi), 0.4 * random.normal());
      cloud.positions.emplace_back(place.x(), place.y(), random.uniform(-40.0, 40.0));
    }
    const auto girth = girth_by_rbf(cloud, test::level_plane(1.3));
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_NEAR(girth->stretched_mm, stretched, 1.5 * *girth->stretched_u95_mm) << seed;
    EXPECT_NEAR(girth->contact_mm, contact, 1.5 * *girth->contact_u95_mm) << seed;
    EXPECT_LT(*girth->stretched_u95_mm, 1.0) << seed;
  }
}

}  // namespace
}  // namespace instep
