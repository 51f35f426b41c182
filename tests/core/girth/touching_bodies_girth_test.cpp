// Girths of two cylinders side by side that touch, or nearly: the points hardly tell that they are
// two. Round both the tape would be 90 mm longer than round the larger one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

constexpr double kRadius = 35.0;
constexpr double kOtherRadius = 25.0;
/// Of many intervals that hold in 95 % of cases.
constexpr double kThreeSigmas = 1.5;

/// What a tape gains where it takes a little of the other one with it, mm.
constexpr double kOfTheOther = 5.0;

/// `apart_mm` < 0: pressed into each other, without the points inside, which no camera sees.
PointCloud two_cylinders(std::size_t count, double apart_mm, double sigma_mm, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  const double middle = kRadius + apart_mm + kOtherRadius;
  PointCloud cloud;
  while (cloud.positions.size() < count) {
    const bool is_first = random.uniform(0.0, kRadius + kOtherRadius) < kRadius;
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double radius = (is_first ? kRadius : kOtherRadius) + sigma_mm * random.normal();
    const double x = (is_first ? 0.0 : middle) + radius * std::cos(angle);
    const double y = radius * std::sin(angle);
    const double inside =
        is_first ? kOtherRadius - std::hypot(x - middle, y) : kRadius - std::hypot(x, y);
    if (apart_mm < 0.0 && inside > 0.0) continue;
    cloud.positions.emplace_back(x, y, random.uniform(-30.0, 30.0));
  }
  return cloud;
}

bool says(const Girth& girth, const char* words) {
  return std::any_of(girth.warnings.begin(), girth.warnings.end(),
                     [&](const auto& warning) { return warning.find(words) != std::string::npos; });
}

/// Round both it is told only with a warning, of two pressed into each other; else it is that of
/// the larger one, or none.
void expect_no_wrong_girth(const Result<Girth>& girth, double apart_mm) {
  if (!girth) {
    const bool is_right = girth.error().code == ErrorCode::kInvalidInput ||
                          girth.error().code == ErrorCode::kInsufficientData;
    EXPECT_TRUE(is_right) << girth.error().line();
    return;
  }
  if (apart_mm < 0.0 && says(*girth, "a waist of")) return;
  EXPECT_NEAR(girth->stretched_mm, 2.0 * std::numbers::pi * kRadius,
              kThreeSigmas * *girth->stretched_u95_mm + kOfTheOther);
}

/// They were told round both without a word, +92 mm with an interval of 1, or of the smaller one.
TEST(GirthOfTouchingBodies, IsOfTheLargerOneOrNotToldWithoutAWord) {
  int pinched = 0;
  int told = 0;
  for (const double apart_mm : {-4.0, -1.0, 0.0, 0.5, 1.0, 2.0}) {
    for (const double sigma_mm : {0.2, 0.4}) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(testing::Message() << apart_mm << " " << sigma_mm << " " << seed);
        const auto girth =
            girth_by_rbf(two_cylinders(10000, apart_mm, sigma_mm, seed), test::level_plane(1.3));
        expect_no_wrong_girth(girth, apart_mm);
        if (girth) ++told;
        if (!girth && girth.error().message.find("pinched") != std::string::npos) ++pinched;
      }
    }
  }
  EXPECT_GT(pinched, 1);
  EXPECT_GT(told, 8);
}

/// Of the outline of an hourglass whose neck is so wide.
Eigen::Vector2d place_on_hourglass(double neck_mm, double angle) {
  const double least = 0.5 * neck_mm;
  const double radius = least + (45.0 - least) * 0.5 * (1.0 + std::cos(2.0 * angle));
  return radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

double tape_round_hourglass(double neck_mm) {
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < 20000; ++i) {
    corners.push_back(place_on_hourglass(neck_mm, 2.0 * std::numbers::pi * i / 20000));
  }
  return perimeter(convex_hull(std::move(corners)));
}

/// A body that the points plainly show to be one is told, however narrow its neck.
TEST(GirthOfAnHourglass, IsTold) {
  for (const double neck_mm : {10.0, 16.0}) {
    for (const double sigma_mm : {0.0, 0.2}) {
      SCOPED_TRACE(testing::Message() << neck_mm << " " << sigma_mm);
      test::RandomNumbers random(4);
      PointCloud cloud;
      for (int i = 0; i < 10000; ++i) {
        const auto place = place_on_hourglass(neck_mm, random.uniform(0.0, 2.0 * std::numbers::pi));
        const Eigen::Vector2d moved = place + sigma_mm * random.normal() * place.normalized();
        cloud.positions.emplace_back(moved.x(), moved.y(), random.uniform(-30.0, 30.0));
      }
      const auto girth = girth_by_rbf(cloud, test::level_plane(1.3));
      ASSERT_TRUE(girth) << girth.error().line();
      EXPECT_NEAR(girth->stretched_mm, tape_round_hourglass(neck_mm),
                  kThreeSigmas * *girth->stretched_u95_mm);
      EXPECT_TRUE(says(*girth, "a waist of"));
    }
  }
}

}  // namespace
}  // namespace instep
