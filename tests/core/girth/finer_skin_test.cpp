#include "core/girth/finer_skin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

constexpr double kLength = 2.5;
constexpr int kKnots = 42;

/// Waves round a line.
struct Waves {
  int count = 0;
  double height = 0.0;

  double at(double way) const {
    return height * std::cos(2.0 * std::numbers::pi * count * way / kLength);
  }
};

/// Under noise, which is three times as much on a quarter of the line.
std::vector<RibbonPoint> drawn(const Waves& waves, int count, double sigma, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<RibbonPoint> points;
  for (int i = 0; i < count; ++i) {
    const double way = random.uniform(0.0, kLength);
    const double noise = (way < 0.25 * kLength ? 1.5 : 0.5) * sigma * random.normal();
    points.push_back({way, random.uniform(-1.0, 1.0), waves.at(way) + noise, 1.0});
  }
  return points;
}

std::optional<FinerSkin> over_spline(const std::vector<RibbonPoint>& points) {
  const auto spline = RibbonSpline::through(points, kLength, kKnots);
  if (!spline) throw std::runtime_error("no spline");
  return finer_skin_over(*spline, points, kLength);
}

TEST(FinerSkin, IsToldBelowTheNoise) {
  constexpr double kHeight = 0.002;
  for (const int waves : {30, 40, 60, 100}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const auto shown = over_spline(drawn({waves, kHeight}, 30000, 0.004, seed));
      ASSERT_TRUE(shown) << waves << " " << seed;
      const double height = kHeight / std::numbers::sqrt2;
      const double slope = 2.0 * std::numbers::pi * waves / kLength * height;
      EXPECT_NEAR(shown->height, height, 0.15 * height) << waves << " " << seed;
      EXPECT_NEAR(shown->slope, slope, 0.15 * slope) << waves << " " << seed;
    }
  }
}

TEST(FinerSkin, IsNotShownByNoiseNorByWavesThatTheSplineFollows) {
  int shown = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    if (over_spline(drawn({}, 5000, 0.004, seed))) ++shown;
  }
  EXPECT_LE(shown, 1);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    EXPECT_FALSE(over_spline(drawn({5, 0.02}, 5000, 0.004, seed))) << seed;
  }
}

TEST(FinerSkin, IsNotShownByTooFewPointsNorByNone) {
  EXPECT_FALSE(finer_skin_of({}, kLength, 1));
  EXPECT_FALSE(finer_skin_of({{0.3, 0.0, 0.1, 1.0}}, kLength, 1));
  EXPECT_FALSE(finer_skin_of(drawn({40, 0.01}, 100, 0.004, 1), kLength, 1));
}

/// A body of radius 40 mm with waves round it.
struct WavyBody {
  int waves;
  double height_mm;

  Eigen::Vector2d corner(double angle, double noise_mm) const {
    const double radius = 40.0 + height_mm * std::cos(waves * angle) + noise_mm;
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }

  std::vector<Eigen::Vector2d> outline() const {
    std::vector<Eigen::Vector2d> corners;
    for (int i = 0; i < 40000; ++i) {
      corners.push_back(corner(2.0 * std::numbers::pi * i / 40000, 0.0));
    }
    return corners;
  }

  PointCloud cloud(int points, double sigma_mm, std::uint64_t seed) const {
    test::RandomNumbers random(seed);
    PointCloud cloud;
    for (int i = 0; i < points; ++i) {
      const auto place =
          corner(random.uniform(0.0, 2.0 * std::numbers::pi), sigma_mm * random.normal());
      cloud.positions.emplace_back(place.x(), place.y(), random.uniform(-40.0, 40.0));
    }
    return cloud;
  }
};

bool speaks_of_ribs(const Girth& girth) {
  return std::any_of(girth.warnings.begin(), girth.warnings.end(), [](const std::string& warning) {
    return warning.find("waves or ribs too fine") != std::string::npos;
  });
}

void expect_held(const WavyBody& body, int points, double sigma_mm, double most_u95_mm) {
  const double contact = perimeter(body.outline());
  const double stretched = perimeter(convex_hull(body.outline()));
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    SCOPED_TRACE(seed);
    const auto girth = girth_by_rbf(body.cloud(points, sigma_mm, seed), test::level_plane(1.3));
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_NEAR(girth->stretched_mm, stretched, 1.5 * *girth->stretched_u95_mm);
    EXPECT_NEAR(girth->contact_mm, contact, 1.5 * *girth->contact_u95_mm);
    EXPECT_LT(*girth->stretched_u95_mm, most_u95_mm);
    EXPECT_EQ(speaks_of_ribs(*girth), girth->contact_u95_mm > 1.5);
  }
}

/// The tape was told up to 1 mm too short, +-0.2.
TEST(FinerSkin, IsInTheIntervalOfAGirth) {
  expect_held({22, 0.2}, 10000, 0.4, 2.0);
}

/// As of a ribbed sock, 0.6 mm high and 4 mm apart: the contact length was told 12 mm too short,
/// +-0.2.
TEST(FinerSkin, OfRibsIsInTheIntervalOfAGirth) {
  expect_held({60, 0.3}, 10000, 0.3, 4.0);
}

}  // namespace
}  // namespace instep
